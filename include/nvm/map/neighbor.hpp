// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace nvm {

/// Names a stored point of one map; valid until that map is next changed.
using PointId = std::uint32_t;

/// The largest number of neighbours that one query can ask for.
inline constexpr std::size_t kMaxNeighbors = 64;

/// Which normals must agree with the normal of a query.
enum class Gate : std::uint8_t {
  kSurfaces,  ///< those of the surface and of the point (spec §3.6)
  kPoints,    ///< of the point alone, for a map that keeps no sides
};

/// What a nearest-neighbour query asks for.
struct NearestSearch {
  /// How many neighbours at most, 1 to kMaxNeighbors (larger values are clamped).
  std::size_t count = 5;
  /// Neighbours lie at most this far away [m], inclusive, and in a voxel map within its `rings`.
  double max_distance = 1.0;
  /// Ignored by queries without a normal and by maps without normals.
  Gate gate = Gate::kSurfaces;
  /// Of voxels around that of the query: 1 for the 27, n for (2 n + 1)^3. Answers that the 27 do
  /// not settle take microseconds then, and a millisecond where a large map is far away.
  int rings = 1;
};

/// One answer of a query: a stored point in the map frame.
struct Neighbor {
  Eigen::Vector3d position;  ///< [m], map frame
  float sq_distance;         ///< to the query [m^2]
  PointId id;                ///< for the map's accessors: normal(id), side(id)
};

}  // namespace nvm
