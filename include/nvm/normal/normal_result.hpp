// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/target.hpp"

namespace nvm {

/// What became of a point in normal estimation.
enum class NormalStatus : std::uint8_t {
  kValid,
  kNonFinite,     ///< a coordinate of the point or of its viewpoint is NaN or infinite
  kTooNear,       ///< nearer to its viewpoint than min_range
  kTooFar,        ///< farther from its viewpoint than max_range
  kFarOrigin,     ///< more than 10 km from the first viewpoint: floats are too coarse there
  kFewNeighbors,  ///< fewer points within the radius than min_neighbors
  kLineLike,      ///< max_linearity exceeded, or all neighbours coincide
  kNotPlanar,     ///< max_surface_variation exceeded
};

/// How many points got each status.
struct NormalStats {
  std::size_t valid = 0;
  std::size_t non_finite = 0;
  std::size_t too_near = 0;
  std::size_t too_far = 0;
  std::size_t far_origin = 0;
  std::size_t few_neighbors = 0;
  std::size_t line_like = 0;
  std::size_t not_planar = 0;
};

/// Normals of a range of points, index by index.
struct NormalResult {
  /// Unit normals in the frame of the points that look back at the viewpoint:
  /// n . (viewpoint - p) >= 0. Zero where the status is not kValid.
  std::vector<Eigen::Vector3f> normals;
  /// Signed distance [m] along the normal from each point to the least-squares plane of its
  /// neighbourhood: points[i] + plane_offsets[i] * normals[i] lies on it. Zero as the normals are.
  std::vector<float> plane_offsets;
  /// Mean squared distance [m^2] of the neighbours to that plane; zero as the normals are.
  std::vector<float> plane_variances;
  std::vector<NormalStatus> status;
  NormalStats stats;
};

inline namespace NVM_TARGET {

template <class = void>
NormalStats count_statuses(const std::vector<NormalStatus>& status) {
  constexpr std::size_t kStatuses = static_cast<std::size_t>(NormalStatus::kNotPlanar) + 1;
  std::size_t counts[kStatuses] = {};
  for (const NormalStatus s : status) {
    ++counts[static_cast<std::size_t>(s)];
  }
  const auto count = [&counts](NormalStatus s) { return counts[static_cast<std::size_t>(s)]; };
  return {
      count(NormalStatus::kValid),
      count(NormalStatus::kNonFinite),
      count(NormalStatus::kTooNear),
      count(NormalStatus::kTooFar),
      count(NormalStatus::kFarOrigin),
      count(NormalStatus::kFewNeighbors),
      count(NormalStatus::kLineLike),
      count(NormalStatus::kNotPlanar)};
}

}  // namespace NVM_TARGET
}  // namespace nvm
