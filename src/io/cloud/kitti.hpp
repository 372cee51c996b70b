// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>

#include "io/cloud/point_records.hpp"

namespace nvm::io {

/// Reads a scan without header, float32 in little endian: `fields` numbers a point, from 3 to 6, or
/// 0 to judge by the numbers: x, y, z [m], intensity (KITTI), then ring, and time of newer sets.
/// With 0, the 24-byte records of an nvm sequence are known too. Throws std::runtime_error when the
/// size is no multiple of a point's.
PointRecords read_kitti_points(const std::string& path, std::size_t fields = 0);

}  // namespace nvm::io
