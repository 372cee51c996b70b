// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nvm::io {

/// A file with one scan.
struct ScanFile {
  std::filesystem::path path;
  double time = 0.0;  ///< [s]
};

/// Whether the extension is that of a scan: .pcd, .ply or .bin.
bool is_scan_file(const std::string& path);

/// The scans of a folder, or of its subfolder scans, velodyne, velodyne_points/data,
/// velodyne_points, data, lidar, pcd or bin, in the order of their names; `path` may be one scan
/// too. Files named unlike most of the others ("map.ply" among "000000.ply") are no scans; a note
/// names them. Throws std::runtime_error when there are none.
std::vector<ScanFile> find_scans(const std::string& path, std::vector<std::string>& notes);

/// Dates the scans: by `timestamps.txt` beside them or above (lines "file time", or a time or date
/// per scan), `times.txt` (a time per scan), their names (a time, or SECONDS_NANOSECONDS), else
/// `scan_rate` [Hz]. Drops those without a time, and says so in a note. Throws std::runtime_error,
/// naming the file and line, for times that do not fit.
void date_scans(std::vector<ScanFile>& scans, double scan_rate, std::vector<std::string>& notes);

}  // namespace nvm::io
