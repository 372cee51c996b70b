// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "io/file.hpp"
#include "io/message_pipe.hpp"
#include "io/natural_order.hpp"
#include "io/nvm_sequence_reader.hpp"
#include "io/ros_bag_reader.hpp"
#include "io/scan_files.hpp"
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

/// The .bag files in a folder, in the order of their names.
std::vector<std::string> bags_in(const std::string& folder) {
  std::vector<std::string> bags;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && extension_of(entry.path().string()) == ".bag") {
      bags.push_back(entry.path().string());
    }
  }
  std::sort(bags.begin(), bags.end(), precedes_naturally);
  return bags;
}

std::unique_ptr<SequenceReader> open_folder(
    const std::string& path, const SequenceOptions& options) {
  if (is_nvm_sequence(path)) {
    return open_nvm_sequence(path);
  }
  const std::filesystem::path folder =
      std::filesystem::absolute(path + "/").lexically_normal().parent_path();
  if (folder.filename() == "scans" && is_nvm_sequence(folder.parent_path().string())) {
    return open_nvm_sequence(folder.parent_path().string());
  }
  const auto bags = bags_in(path);
  return bags.empty() ? open_scan_folder(path, options) : open_ros_bags(bags, options);
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
  if (std::filesystem::is_fifo(path)) {
    return open_message_pipe(path, options);
  }
  if (is_ros2_bag(path)) {
    fail(path, "is a ROS 2 bag: the Python package's nvm reads it (docs/python.md: pip install .)");
  }
  if (std::filesystem::is_directory(path)) {
    return open_folder(path, options);
  }
  if (extension_of(path) == ".bag") {
    return open_ros_bags({path}, options);
  }
  if (is_scan_file(path)) {
    return open_scan_folder(path, options);
  }
  fail(
      path,
      "is no sequence: expected a folder of scans, a .pcd, .ply or .bin scan, an nvm sequence "
      "folder, or a .bag file or a folder of them");
}

}  // namespace nvm::io
