// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "fuzz_target.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::fuzz {

/// Requires of `map` what its documentation promises, whatever was done to it.
inline void audit(const VoxelMap& map) {
  const MapOptions& options = map.options();
  const std::vector<MapPoint> points = map.points();
  std::map<std::tuple<double, double, double>, std::map<int, int>> voxels;  // points by surface
  for (const MapPoint& point : points) {
    require(point.position.allFinite(), "stored positions are finite");
    require(point.side >= 0 && point.side < options.max_surfaces, "sides are below max_surfaces");
    const float length = point.normal.norm();
    require(
        length == 0.0F || std::abs(length - 1.0F) < 1e-3F || is_sighting(point.normal),
        "normals are unit vectors, sightings or none");
    const Eigen::Array3d index = (point.position.array() / options.voxel_size).floor();
    ++voxels[{index.x(), index.y(), index.z()}][point.side];
  }
  for (const auto& [index, surfaces] : voxels) {
    int side = 0;
    for (const auto& [stored_side, count] : surfaces) {
      require(stored_side == side++, "a voxel's sides are numbered without gaps");
      require(count <= options.points_per_surface, "no surface holds more than it may");
    }
  }
  require(map.size() == points.size(), "size() is the number of points");
  require(map.empty() == points.empty(), "empty() is size() == 0");
  require(map.voxel_count() == voxels.size(), "voxel_count() is the number of voxels with points");
  require(map.voxel_count() <= options.capacity, "a map holds no more voxels than its capacity");
  require(map.memory_bytes() <= map.memory_limit_bytes(), "a map keeps within its memory");
  const MapStats stats = map.stats();
  require(stats.points == points.size() && stats.voxels == voxels.size(), "stats() counts right");
}

}  // namespace nvm::fuzz
