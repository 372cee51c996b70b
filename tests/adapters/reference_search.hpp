// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nvm::test {

/// The map stores positions on a lattice; two of them, and their distance, may differ from what
/// went in by this much [m] for voxels up to 1 m.
inline constexpr double kLattice = 2.5e-4;

/// The distances [m] of the `count` nearest of `points` that `accept`s takes, ascending.
template <class Points, class Accept>
std::vector<double> nearest_distances(
    const Points& points, const Eigen::Vector3d& query, std::size_t count, const Accept& accept) {
  std::vector<double> distances;
  for (const Eigen::Vector3d& point : points) {
    if (accept(point)) {
      distances.push_back((point - query).norm());
    }
  }
  std::sort(distances.begin(), distances.end());
  distances.resize(std::min(count, distances.size()));
  return distances;
}

}  // namespace nvm::test
