// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <string>

#include "io/sequence/sequence_reader.hpp"

namespace nvm::io {

/// Whether `folder` holds the list of scans of an nvm sequence.
bool is_nvm_sequence(const std::string& folder);

/// Opens an nvm sequence folder (docs/formats.md). Bad rows of scans.csv and imu.csv, scans that
/// are missing, truncated, out of order, outside of the folder or those before again, other counts
/// than meta.json has, times in another unit and what is missing become notes. Throws
/// std::runtime_error for a bad meta.json, a table without its columns, and when no scan is left.
/// Of scans that have been deskewed the times of the points mean nothing: without
/// `has_point_times` all are as of t_begin.
std::unique_ptr<SequenceReader> open_nvm_sequence(
    const std::string& folder, bool has_point_times = true);

}  // namespace nvm::io
