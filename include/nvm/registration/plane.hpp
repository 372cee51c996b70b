// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "nvm/map/neighbor.hpp"

namespace nvm {

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
inline std::optional<Plane> fit_plane(const Neighbor* neighbors, std::size_t count) {
  if (count < 3) {
    return std::nullopt;
  }
  // Relative to a neighbour, so that nothing cancels far from the map's origin.
  const Eigen::Vector3d origin = neighbors[0].position;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sum_of_squares = Eigen::Matrix3d::Zero();
  for (std::size_t i = 1; i < count; ++i) {
    const Eigen::Vector3d d = neighbors[i].position - origin;
    sum += d;
    sum_of_squares.noalias() += d * d.transpose();
  }
  const double share = 1.0 / static_cast<double>(count);
  const Eigen::Vector3d mean = share * sum;
  const Eigen::Matrix3d covariance = share * sum_of_squares - mean * mean.transpose();

  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance);
  const Eigen::Vector3d sigma = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();  // ascending
  constexpr double kCollinear = 1e-3;
  if (!(sigma[2] > 0.0) || sigma[1] < kCollinear * sigma[2]) {
    return std::nullopt;
  }
  return Plane{origin + mean, eigen.eigenvectors().col(0), (sigma[1] - sigma[0]) / sigma[2], sigma};
}

}  // namespace nvm
