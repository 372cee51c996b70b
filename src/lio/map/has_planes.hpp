// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/map/sighting.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::lio {

/// Whether any point of `map` is known to lie on a plane, so that scans can be aligned with it: not
/// so for a map without normals, nor for one of sightings alone (nvm/map/sighting.hpp).
inline bool has_planes(const VoxelMap& map) {
  bool any = false;
  map.for_each_point([&](const MapPoint& point) { any |= !plane_normal(point.normal).isZero(); });
  return any;
}

}  // namespace nvm::lio
