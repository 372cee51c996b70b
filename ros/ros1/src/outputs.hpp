// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/transform_broadcaster.h>

#include <chrono>
#include <string>

#include "frames.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "node_options.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm_ros {

/// Whether a frame has a pose that can be trusted.
bool has_pose(const nvm::lio::FrameResult& frame);

/// The topics that the node publishes, and TF. Nothing is made that nobody listens to.
class Outputs {
 public:
  Outputs(ros::NodeHandle handle, const NodeOptions& options);

  /// Publishes what a scan gave: odometry, TF, the scan, and path and map from time to time.
  void publish(
      const nvm::lio::FrameResult& frame, const nvm::lio::Pipeline& pipeline, const Frames& frames);

  /// Publishes path and map as they are, whether somebody listens or not: latched, for those who
  /// come later.
  void publish_all(const nvm::lio::Pipeline& pipeline);

  void publish(const diagnostic_msgs::DiagnosticStatus& status);

  /// Waits until all who listen already are connected, for some seconds at most.
  void wait_for_listeners() const;

  /// Forgets the poses.
  void reset() { trajectory_.clear(); }

  /// The base's poses so far. From a million on, every second one is forgotten.
  const nvm::Trajectory& trajectory() const { return trajectory_; }

 private:
  using Clock = std::chrono::steady_clock;

  void remember(const nvm::StampedPose& pose);
  void publish_path();
  void publish_map(const nvm::lio::Pipeline& pipeline);

  NodeOptions options_;
  ros::Publisher odometry_, path_, frame_, map_, status_;
  tf2_ros::TransformBroadcaster tf_;
  nvm::Trajectory trajectory_;
  Clock::time_point next_path_;
  Clock::time_point next_map_;
};

}  // namespace nvm_ros
