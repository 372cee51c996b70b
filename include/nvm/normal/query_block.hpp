// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "nvm/geometry/float_lanes.hpp"
#include "nvm/geometry/moments.hpp"
#include "nvm/normal/spatial_order.hpp"

namespace nvm::detail {

/// Passes over the queries of a block, kLaneCount at a time.
inline constexpr std::size_t kLaneGroups = kBlockSize / kLaneCount;

/// Moments of the neighbours of each query of a block, relative to that query.
using BlockMoments = std::array<Moments<FloatLanes>, kLaneGroups>;

/// Squared length [m^2]: of the difference of two points, it is compared to the squared radius. A
/// neighbour is a point with sq_length <= sq_radius, inclusive, whatever finds it.
template <class Real>
Real sq_length(const Real& x, const Real& y, const Real& z) {
  return multiply_add<Real>(z, z, multiply_add<Real>(y, y, x * x));
}

/// Up to kBlockSize consecutive queries of a spatial order and the box around them.
struct QueryBlock {
  const float *x, *y, *z, *sq_radius;  // kBlockSize each; NaN where there is no query
  std::size_t size;
  float min_x, min_y, min_z, max_x, max_y, max_z;
  float min_sq_radius, max_sq_radius;

  QueryBlock(const SpatialOrder& queries, std::size_t block)
      : x(&queries.x[block * kBlockSize]),
        y(&queries.y[block * kBlockSize]),
        z(&queries.z[block * kBlockSize]),
        sq_radius(&queries.sq_radius[block * kBlockSize]),
        size(std::min(kBlockSize, queries.size() - block * kBlockSize)),
        min_x(*std::min_element(x, x + size)),
        min_y(*std::min_element(y, y + size)),
        min_z(*std::min_element(z, z + size)),
        max_x(*std::max_element(x, x + size)),
        max_y(*std::max_element(y, y + size)),
        max_z(*std::max_element(z, z + size)),
        min_sq_radius(*std::min_element(sq_radius, sq_radius + size)),
        max_sq_radius(*std::max_element(sq_radius, sq_radius + size)) {}
};

}  // namespace nvm::detail
