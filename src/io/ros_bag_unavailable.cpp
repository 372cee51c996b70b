// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file.hpp"
#include "io/ros_bag_reader.hpp"

namespace nvm::io {

// Stands in for ros_bag_reader.cpp where rosbag_storage is missing.
std::unique_ptr<SequenceReader> open_ros_bag(const std::string& path, const SequenceOptions&) {
  fail(
      path,
      "nvm was built without ROS 1 bags (Debian packages librosbag-storage-dev and "
      "libsensor-msgs-dev)");
}

}  // namespace nvm::io
