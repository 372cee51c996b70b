// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "nvm/geometry/moments.hpp"
#include "nvm/geometry/symmetric_eigen.hpp"
#include "nvm/normal/normal_options.hpp"
#include "nvm/normal/normal_result.hpp"
#include "nvm/normal/query_block.hpp"

namespace nvm::detail {

/// From the moments of neighbourhoods to normals or to the reasons why there are none (spec §2.3
/// and §2.4).
class PlaneJudge {
 public:
  explicit PlaneJudge(const NormalOptions& options)
      : min_neighbors_(static_cast<float>(options.min_neighbors)),
        max_linearity_(static_cast<float>(options.max_linearity)),
        max_surface_variation_(static_cast<float>(options.max_surface_variation)) {}

  /// Writes status and normal, of either sign, of one block of queries.
  void operator()(
      const BlockMoments& sums,
      const SpatialOrder& queries,
      std::size_t block,
      NormalResult& result) const {
    for (std::size_t group = 0; group < kLaneGroups; ++group) {
      const Eigen3<FloatLanes> eigen = eigen_decomposition(scatter(sums[group]));
      const std::size_t first = block * kBlockSize + group * kLaneCount;
      const std::size_t last = std::min(first + kLaneCount, queries.size());
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t lane = i - first;
        const std::uint32_t out = queries.index[i];
        result.status[out] = status(
            sums[group].count[lane], eigen.smallest[lane], eigen.middle[lane], eigen.largest[lane]);
        if (result.status[out] == NormalStatus::kValid) {
          const Vector3Of<FloatLanes>& normal = eigen.smallest_vector;
          result.normals[out] = {normal.x[lane], normal.y[lane], normal.z[lane]};
        }
      }
    }
  }

 private:
  NormalStatus status(float count, float smallest, float middle, float largest) const {
    const float sum = smallest + middle + largest;
    if (!(count >= min_neighbors_)) {
      return NormalStatus::kFewNeighbors;
    }
    if (!(sum > 0.0F && largest <= max_linearity_ * sum)) {
      return NormalStatus::kLineLike;
    }
    if (!(smallest <= max_surface_variation_ * sum)) {
      return NormalStatus::kNotPlanar;
    }
    return NormalStatus::kValid;
  }

  float min_neighbors_, max_linearity_, max_surface_variation_;
};

}  // namespace nvm::detail
