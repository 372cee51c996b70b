// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "io/cloud/point_records.hpp"
#include "nvm/map/point_values.hpp"

namespace nvm::io {

/// The points of a map, in the map frame. `normals`, `sides` and `values` are empty or as long as
/// `positions`.
struct MapCloud {
  std::vector<Eigen::Vector3d> positions;  ///< [m]
  std::vector<Eigen::Vector3f> normals;    ///< unit vectors
  std::vector<std::uint8_t> sides;         ///< 0: front, 1: back (and on with more surfaces)
  MapColumns columns;                      ///< which of the values there are
  std::vector<PointValues> values;
};

/// Reads x y z and, where they exist, nx ny nz (or normal_x normal_y normal_z) and side; no values.
/// Throws std::runtime_error, naming the source, without x y z.
MapCloud map_cloud_from(const PointRecords& records);

/// Reads a .ply or .pcd file. Throws std::runtime_error.
MapCloud read_map_cloud(const std::string& path);

/// Writes a .ply file (x y z, nx ny nz, side, and the columns: intensity, time, red green blue,
/// label) or a .pcd file (normal_x normal_y normal_z instead), by the extension. Coordinates are
/// float32, or float64 when one is 4096 m or more from zero, so that writing moves no point by more
/// than 0.2 mm. Throws std::runtime_error when the file cannot be written or has another extension,
/// std::invalid_argument for ranges of unequal length.
void write_map_cloud(const std::string& path, const MapCloud& cloud);

}  // namespace nvm::io
