// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/message/message_source.hpp"
#include "node_options.hpp"

namespace nvm_ros {

/// The topics of a run; no IMU topic means odometry from scans alone.
struct Topics {
  std::string lidar;
  std::string imu;
  std::vector<std::string> notes;  ///< what was chosen among several, or is missing
};

/// The topics that are published but not by this node, in order of their names.
std::vector<nvm::io::MessageTopic> published_topics();

/// The topics that `options` name, and for those that they leave open what `list` offers. Asks
/// again until there is a LiDAR topic, and then for options.detection_time until there is an IMU
/// topic; `goes_on` false ends it early.
Topics find_topics(
    const NodeOptions& options,
    const std::function<std::vector<nvm::io::MessageTopic>()>& list,
    const std::function<bool()>& goes_on);

}  // namespace nvm_ros
