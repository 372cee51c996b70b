// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>

namespace nvm {

/// What became of the points of one insertion. The first eight add up to the number of points
/// given.
struct InsertStats {
  std::size_t stored = 0;
  std::size_t settled = 0;       ///< stored in the place of a sighting (sighting.hpp)
  std::size_t too_close = 0;     ///< to a point of the same surface and voxel: min_point_distance
  std::size_t surface_full = 0;  ///< points_per_surface reached
  std::size_t no_normal = 0;     ///< zero, non-finite, or of another length than 1 and 1/2
  std::size_t non_finite = 0;    ///< position with NaN or inf
  std::size_t out_of_range = 0;  ///< beyond +-2^20 voxels
  std::size_t map_full =
      0;  ///< no room even after evicting every other voxel (only when max_bytes is tiny)
  std::size_t new_voxels = 0;
  std::size_t evicted_voxels = 0;
  std::size_t evicted_points = 0;
};

}  // namespace nvm
