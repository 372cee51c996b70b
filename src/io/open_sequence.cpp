// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "io/file.hpp"
#include "io/nvm_sequence_reader.hpp"
#include "io/ros_bag_reader.hpp"
#include "io/scan_folder.hpp"
#include "io/sequence_reader.hpp"

namespace nvm::io {

namespace {

bool is_ros2_bag(const std::string& path) {
  const std::string metadata = path + "/metadata.yaml";
  const std::string extension = extension_of(path);
  return extension == ".mcap" || extension == ".db3" ||
         (std::filesystem::exists(metadata) &&
          read_file(metadata).find("rosbag2_bagfile_information") != std::string::npos);
}

}  // namespace

std::unique_ptr<SequenceReader> open_sequence(
    const std::string& path, const SequenceOptions& options) {
  if (!(options.scan_rate >= 0.01 && options.scan_rate <= 1000.0)) {
    throw std::invalid_argument(
        fmt::format("scan_rate = {}: must be from 0.01 to 1000", options.scan_rate));
  }
  if (!std::filesystem::exists(path)) {
    fail(path, "does not exist");
  }
  if (is_ros2_bag(path)) {
    fail(path, "is a ROS 2 bag: convert it first with 'scripts/convert_bag.py BAG FOLDER'");
  }
  if (std::filesystem::is_directory(path)) {
    return is_nvm_sequence(path) ? open_nvm_sequence(path) : open_scan_folder(path, options);
  }
  if (extension_of(path) == ".bag") {
    return open_ros_bag(path, options);
  }
  fail(path, "is no sequence: expected a folder of scans, an nvm sequence folder or a .bag file");
}

}  // namespace nvm::io
