// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

namespace nvm::io {

/// Checks the container of a ROS 1 bag (format 2.0, http://wiki.ros.org/Bags/Format/2.0) before
/// rosbag_storage opens it, which follows every length and position in the file without a check:
/// every record lies within its file or chunk and has its fields, and every index entry points to a
/// message. Of a compressed chunk only the outside is looked at; its inside has a checksum. Takes
/// time in proportion to the number of messages, not of bytes. Throws std::runtime_error, naming
/// the file and what is wrong.
void check_ros_bag(const std::string& path);

}  // namespace nvm::io
