// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "io/cloud/point_records.hpp"

namespace nvm::io {

/// Reads a PCD file (v0.7; DATA ascii, binary or binary_compressed) with any fields. The viewpoint
/// is not applied. Throws std::runtime_error, naming the file and what is wrong, for a truncated or
/// corrupt one; never allocates more than a fixed multiple of the file's size.
PointRecords read_pcd(const std::string& path);

/// Writes a PCD file (v0.7, DATA binary) with the fields of `records` (little endian). Throws
/// std::runtime_error when it cannot be written.
void write_pcd(const std::string& path, const PointRecords& records);

}  // namespace nvm::io
