// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

#include "io/file/file.hpp"
#include "io/file/natural_order.hpp"
#include "io/message/message_pipe.hpp"
#include "io/message/ros_bag_reader.hpp"
#include "io/sequence/nvm_sequence_reader.hpp"
#include "io/sequence/scan_files.hpp"
#include "io/sequence/scan_folder.hpp"
#include "io/sequence/sequence_reader.hpp"

namespace nvm::io {

namespace {

bool has_ros2_extension(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".mcap" || extension == ".db3";
}

/// The regular files in a folder, in the order of their names.
std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end(), precedes_naturally);
  return files;
}

bool is_ros2_bag(const std::string& path) {
  if (!std::filesystem::is_directory(path)) {
    return has_ros2_extension(path);
  }
  const std::string metadata = path + "/metadata.yaml";
  if (std::filesystem::exists(metadata) &&
      read_file(metadata).find("rosbag2_bagfile_information") != std::string::npos) {
    return true;
  }
  const std::vector<std::string> files = files_in(path);
  return std::any_of(files.begin(), files.end(), has_ros2_extension) &&
         std::none_of(files.begin(), files.end(), is_scan_file);
}

/// Whether the file is a ROS 1 bag, whatever its name: "run.bag.active" is one that was not closed.
bool begins_as_bag(const std::string& path) {
  constexpr std::string_view kMagic = "#ROSBAG V";
  std::string begin(kMagic.size(), '\0');
  open_to_read(path).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == kMagic;
}

/// The bags in a folder, in the order of their names.
std::vector<std::string> bags_in(const std::string& folder) {
  std::vector<std::string> bags;
  for (const std::string& path : files_in(folder)) {
    const std::string extension = extension_of(path);
    if (extension == ".bag" || (extension == ".active" && begins_as_bag(path))) {
      bags.push_back(path);
    }
  }
  return bags;
}

/// What makes a sequence of a file that is none; empty when that is not known.
std::string remedy(const std::string& path) {
  const std::string extension = extension_of(path);
  const auto is_one_of = [&](std::initializer_list<const char*> extensions) {
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
  };
  if (is_one_of({".pcap", ".pcapng", ".osf"})) {
    return ". It holds the sensor's packets: nvm of the Python package reads those of Ouster and "
           "Velodyne (docs/python.md), and other makers' drivers write ROS bags or scans";
  }
  if (is_one_of({".las", ".laz", ".e57", ".xyz", ".txt", ".csv", ".npy", ".npz", ".pts"})) {
    return ". CloudCompare or PDAL make PLY or PCD files of points";
  }
  if (is_one_of({".gz", ".bz2", ".xz", ".zst", ".lz4", ".zip", ".tar", ".tgz", ".7z"})) {
    return ". It is packed: unpack it first";
  }
  return "";
}

std::unique_ptr<SequenceReader> open_folder(
    const std::string& path, const SequenceOptions& options) {
  const bool has_point_times = options.point_time_field != "none";
  if (is_nvm_sequence(path)) {
    return open_nvm_sequence(path, has_point_times);
  }
  const std::filesystem::path folder =
      std::filesystem::absolute(path + "/").lexically_normal().parent_path();
  if (folder.filename() == "scans" && is_nvm_sequence(folder.parent_path().string())) {
    return open_nvm_sequence(folder.parent_path().string(), has_point_times);
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
  if (is_scan_file(path)) {
    return open_scan_folder(path, options);
  }
  if (extension_of(path) == ".bag" || begins_as_bag(path)) {
    return open_ros_bags({path}, options);
  }
  fail(
      path,
      "is no sequence: expected a folder of scans, a .pcd, .ply or .bin scan, an nvm sequence "
      "folder, or a .bag file or a folder of them" +
          remedy(path));
}

}  // namespace nvm::io
