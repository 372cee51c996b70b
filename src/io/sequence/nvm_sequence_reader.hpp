// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <string>

#include "io/sequence/sequence_reader.hpp"

namespace nvm::io {

/// Whether `folder` holds the list of scans of an nvm sequence.
bool is_nvm_sequence(const std::string& folder);

/// Opens an nvm sequence folder (docs/formats.md). Reading is strict: std::runtime_error names the
/// file and the line or point for a missing or truncated file, another layout, a time that repeats
/// or goes back, points out of order, numbers that are not finite, and a scan outside of the
/// folder. Bad rows and gaps of imu.csv, a missing imu.csv and a missing T_imu_lidar become notes.
std::unique_ptr<SequenceReader> open_nvm_sequence(const std::string& folder);

}  // namespace nvm::io
