// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/kitti.hpp"

#include "io/file.hpp"

namespace nvm::io {

PointRecords read_kitti_points(const std::string& path) {
  PointRecords records;
  records.source = path;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    records.add_field(name, ScalarType::kFloat32);
  }
  records.bytes = read_file(path);
  records.size = records.bytes.size() / records.record_size;
  if (records.size * records.record_size != records.bytes.size()) {
    fail(
        path,
        std::to_string(records.bytes.size()) +
            " bytes are no whole number of 16-byte points: truncated, or no KITTI scan");
  }
  return records;
}

}  // namespace nvm::io
