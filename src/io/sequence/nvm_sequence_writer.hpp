// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"
#include "io/file/file.hpp"
#include "io/file/pending_path.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::io {

/// Writes an nvm sequence folder (docs/formats.md), one scan at a time. Everything goes to
/// a PendingPath: a folder with the final name is always whole. Without commit() nothing is left.
///
/// Every member throws std::runtime_error, naming the file, when it cannot be written.
class NvmSequenceWriter {
 public:
  /// Throws std::runtime_error as well when `folder` exists.
  explicit NvmSequenceWriter(const std::string& folder);

  void add_scan(const Scan& scan);
  /// Appends to the samples written before.
  void write_imu(const std::vector<ImuSample>& samples);
  void write_groundtruth(const Trajectory& T_world_imu);
  /// A text file of the folder, such as meta.json.
  void write_text(const std::string& name, const std::string& text);

  /// Puts the folder in place.
  void commit();

 private:
  PendingPath pending_;
  std::filesystem::path folder_;  ///< under its temporary name
  std::ofstream scan_list_;
  std::ofstream imu_;
  std::size_t scan_count_ = 0;
};

}  // namespace nvm::io
