// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "node_options.hpp"
#include "nvm/geometry/pose.hpp"

namespace tf2 {
class BufferCore;
}

namespace nvm_ros {

/// The frames of a run (REP 105) and where they are on the robot. The body, whose pose the odometry
/// estimates, is the IMU, or the LiDAR without an IMU.
struct Frames {
  std::string base;  ///< what TF and odometry say the pose of
  nvm::Pose T_body_lidar = nvm::Pose::Identity();
  nvm::Pose T_body_base = nvm::Pose::Identity();
  std::vector<std::string> notes;  ///< what had to be assumed, one line each
};

/// Finds the frames of a LiDAR whose messages are in frame `lidar` and of an IMU, if there is one,
/// in frame `imu`. What TF does not tell becomes the identity, with a note. Waits for TF up to
/// options.tf_timeout (wall time). Throws std::invalid_argument for options that are no pose.
Frames find_frames(
    const tf2::BufferCore& tf,
    const std::string& lidar,
    const std::optional<std::string>& imu,
    const NodeOptions& options);

}  // namespace nvm_ros
