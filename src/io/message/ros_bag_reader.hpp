// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/message/message_source.hpp"
#include "io/sequence/sequence_reader.hpp"

namespace nvm::io {

/// The messages of the ROS 1 bags of one recording, in any order. Throws std::runtime_error, naming
/// the file, when it is no bag.
std::unique_ptr<MessageSource> ros_bag_messages(const std::vector<std::string>& paths);

/// Opens the ROS 1 bags of one recording, in any order: clouds (sensor_msgs/PointCloud2, or
/// CustomMsg of livox_ros_driver and livox_ros_driver2) of one topic and sensor_msgs/Imu of
/// another. Messages that are damaged, repeat, come late, or hold absurd numbers are left out and
/// counted in a note. Throws std::runtime_error, naming the file, when it is no bag or has no such
/// topic.
std::unique_ptr<SequenceReader> open_ros_bags(
    const std::vector<std::string>& paths, const SequenceOptions& options);

}  // namespace nvm::io
