// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <string>

#include "io/sequence_reader.hpp"

namespace nvm::io {

/// Opens a ROS 1 bag: clouds (sensor_msgs/PointCloud2, or CustomMsg of livox_ros_driver and
/// livox_ros_driver2) of one topic and sensor_msgs/Imu of another. IMU messages that repeat or go
/// back in time, or hold numbers that are not finite, are left out and counted in a note. Throws
/// std::runtime_error, naming the file, when it is no readable bag, has no such topic, holds a bad
/// message, or when nvm was built without ROS 1 bags.
std::unique_ptr<SequenceReader> open_ros_bag(
    const std::string& path, const SequenceOptions& options);

}  // namespace nvm::io
