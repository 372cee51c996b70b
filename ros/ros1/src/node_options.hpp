// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>

#include "io/sequence/sequence_reader.hpp"
#include "lio/pipeline/pipeline_options.hpp"

namespace nvm::config {
class Schema;
}

namespace nvm_ros {

enum class Mode {
  kOnline,   ///< what is published on the topics, as it comes
  kOffline,  ///< a bag, as fast as it can be read
};

/// All parameters of the node. Those of the odometry have the names of a run's configuration
/// (`nvm run --print-config`), so that one YAML file serves both.
struct NodeOptions {
  Mode mode = Mode::kOnline;
  std::string bag;              ///< of offline mode
  double detection_time = 3.0;  ///< [s]
  std::size_t queue_size = 10;  ///< scans
  double imu_timeout = 0.25;    ///< [s]
  std::string odom_frame = "odom";
  std::string base_frame;   ///< empty: the root of the sensor's tree in TF
  bool publish_tf = true;   ///< odom_frame -> base_frame
  double tf_timeout = 0.5;  ///< [s]
  double map_period = 2.0;  ///< [s]; 0: the map is not published
  std::string save_folder;  ///< empty: nvm in $ROS_HOME or ~/.ros
  bool exit_when_done = true;
  nvm::io::SequenceOptions input;
  nvm::lio::PipelineOptions pipeline;
};

/// Binds the parameters' names to `options`.
void bind(nvm::config::Schema& schema, NodeOptions& options);

/// The parameters in the node's private namespace. Throws std::invalid_argument, naming the
/// parameter, for an unknown one and for a bad value.
NodeOptions read_parameters();

}  // namespace nvm_ros
