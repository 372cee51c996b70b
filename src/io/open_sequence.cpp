// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <filesystem>

#include "io/file.hpp"
#include "io/nvm_sequence_reader.hpp"
#include "io/ros_bag_reader.hpp"
#include "io/scan_folder.hpp"
#include "io/sequence_reader.hpp"

namespace nvm::io {

namespace {

constexpr char kRos2Advice[] =
    "is a ROS 2 bag: convert it first with 'scripts/convert_bag.py BAG FOLDER'";

}  // namespace

std::unique_ptr<SequenceReader> open_sequence(
    const std::string& path, const SequenceOptions& options) {
  if (!std::filesystem::exists(path)) {
    fail(path, "does not exist");
  }
  if (std::filesystem::exists(path + "/metadata.yaml")) {
    fail(path, kRos2Advice);
  }
  if (std::filesystem::is_directory(path)) {
    return is_nvm_sequence(path) ? open_nvm_sequence(path) : open_scan_folder(path, options);
  }
  const std::string extension = extension_of(path);
  if (extension == ".bag") {
    return open_ros_bag(path, options);
  }
  if (extension == ".mcap" || extension == ".db3") {
    fail(path, kRos2Advice);
  }
  fail(path, "is no sequence: expected a folder of scans, an nvm sequence folder or a .bag file");
}

}  // namespace nvm::io
