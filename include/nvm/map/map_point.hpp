// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "nvm/core/point_access.hpp"
#include "nvm/core/target.hpp"
#include "nvm/map/point_values.hpp"

namespace nvm {

/// A stored point of a map.
struct MapPoint {
  Eigen::Vector3d position;  ///< [m], map frame
  Eigen::Vector3f
      normal;  ///< unit length, looks at where the point was seen from; a sighting or zero: none
  int side;    ///< surface of its voxel: 0 front, 1 back
  PointValues values = {};  ///< those that the map keeps (MapOptions::columns), zero the others
};

template <>
struct PointAccess<MapPoint> {
  NVM_SHARED static Eigen::Vector3d position(const MapPoint& point) { return point.position; }
};

/// What a map holds. Counting takes time proportional to the map.
struct MapStats {
  std::size_t points = 0;
  std::size_t voxels = 0;
  std::size_t two_sided_voxels = 0;  ///< with more than one surface
  std::size_t surfaces = 0;
  std::size_t memory_bytes = 0;
};

}  // namespace nvm
