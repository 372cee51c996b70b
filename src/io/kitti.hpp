// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "io/point_records.hpp"

namespace nvm::io {

/// Reads a scan of the KITTI benchmark: float32 x, y, z [m], intensity, little endian, no header.
/// Throws std::runtime_error when the size is no multiple of 16 bytes.
PointRecords read_kitti_points(const std::string& path);

}  // namespace nvm::io
