// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "io/sequence/left_out.hpp"

namespace nvm::io {

/// A row of a sequence's scans.csv. Times in the file's unit until scan_time_unit() is applied.
struct ScanEntry {
  std::string path;
  double t_begin = 0.0;
  double t_end = 0.0;
  double next_begin =
      std::numeric_limits<double>::infinity();  ///< of the next scan, told or expected
};

/// The rows as they stand in the scans.csv of `folder`; bad ones are counted instead. Throws
/// std::runtime_error when it lacks a column.
std::vector<ScanEntry> read_scan_list(const std::string& folder, LeftOut& bad_rows);

/// The seconds of the times' unit, by how long the scans last, or the steps between them.
double scan_time_unit(const std::vector<ScanEntry>& scans);

}  // namespace nvm::io
