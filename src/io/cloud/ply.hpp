// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/cloud/point_records.hpp"

namespace nvm::io {

/// The type that PLY calls `name`; nothing for other names.
std::optional<ScalarType> ply_type(std::string_view name);

/// Reads the vertices of a PLY file (1.0; ascii, binary_little_endian or binary_big_endian) with
/// any scalar properties; other elements are left out. Throws std::runtime_error, naming the file
/// and what is wrong, for a truncated or corrupt one, for list properties of vertices, and for
/// elements with lists before them; never allocates more than a fixed multiple of the file's size.
PointRecords read_ply(const std::string& path);

/// Writes a PLY file (1.0, binary_little_endian) whose vertices have the fields of `records`
/// (little endian, one value each, no 64-bit integers). Throws std::runtime_error when it cannot be
/// written.
void write_ply(const std::string& path, const PointRecords& records);

}  // namespace nvm::io
