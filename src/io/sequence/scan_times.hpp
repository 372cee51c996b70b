// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "io/sequence/scan_files.hpp"

namespace nvm::io {

/// By a file of lines "file time", whose order the scans take, dropping those that it does not
/// list; or of one time [s] or date ("2011-09-26 13:02:25.594360375", UTC) for each scan. Throws
/// std::runtime_error, naming the line.
void date_by_list(std::vector<ScanFile>& scans, const std::string& path);

/// By a file of one time [s] for each scan. When the names are numbers of lines, counted from zero,
/// scans may be missing. Throws std::runtime_error.
void date_by_line(std::vector<ScanFile>& scans, const std::string& path);

/// By the times that the names spell: seconds with a point, seconds_nanoseconds, or at least ten
/// digits of s, ms, us or ns. False, and no change, unless all names do.
bool date_by_name(std::vector<ScanFile>& scans);

}  // namespace nvm::io
