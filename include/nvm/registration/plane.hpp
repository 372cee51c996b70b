// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/geometry/moments.hpp"
#include "nvm/geometry/symmetric_eigen.hpp"
#include "nvm/map/neighbor.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// A plane through map points.
struct Plane {
  Eigen::Vector3d centroid;  ///< of the points [m], map frame; the least-squares plane contains it
  Eigen::Vector3d normal;    ///< unit, map frame; its sign is arbitrary until it is oriented
  double planarity;          ///< a2D = (sigma2 - sigma3) / sigma1 (spec §4), 0 (a line) to 1
  Eigen::Vector3d
      deviation;  ///< of the points [m], ascending: along the normal, then within the plane
};

/// The least-squares plane of `count` neighbours (PCA), or nothing when they do not span one: fewer
/// than three, coincident or collinear points.
template <class = void>
std::optional<Plane> fit_plane(const Neighbor* neighbors, std::size_t count) {
  if (count < 3) {
    return std::nullopt;
  }
  // Relative to a neighbour, so that nothing cancels far from the map's origin.
  const Eigen::Vector3d origin = neighbors[0].position;
  Moments<double> moments;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d offset = detail::difference(neighbors[i].position, origin);
    moments.add(1.0, offset.x(), offset.y(), offset.z());
  }
  const Eigen3<double> eigen = eigen_decomposition(scatter(moments));
  const double share = 1.0 / static_cast<double>(count);
  const auto root = [share](double sum) { return std::sqrt(std::max(share * sum, 0.0)); };
  const Eigen::Vector3d deviation(root(eigen.smallest), root(eigen.middle), root(eigen.largest));
  constexpr double kCollinear = 1e-3;
  if (!(deviation[2] > 0.0) || deviation[1] < kCollinear * deviation[2]) {
    return std::nullopt;
  }
  const auto& [x, y, z] = eigen.smallest_vector;
  return Plane{
      {origin.x() + share * moments.x,
       origin.y() + share * moments.y,
       origin.z() + share * moments.z},
      {x, y, z},
      (deviation[1] - deviation[0]) / deviation[2],
      deviation};
}

}  // namespace NVM_TARGET
}  // namespace nvm
