// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace nvm::eval {

/// The plane {p : normal . p = offset}, facing along its unit normal.
struct OrientedPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0.0;  ///< [m]

  /// Signed distance of `p` [m], positive in front of the plane.
  double distance(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
};

/// How the plane of a face is found among the points near it.
struct FaceFitOptions {
  double gate = 0.15;           ///< points this far from the plane take part at most [m]
  std::size_t min_points = 30;  ///< fewer points do not make a face
};

/// The surface of one face as the map has it.
struct FaceFit {
  OrientedPlane plane;
  std::vector<Eigen::Vector3d> points;  ///< those that the plane was fitted to
  double spread = 0.0;                  ///< RMS distance of `points` to the plane [m]
};

/// The least-squares plane of the points around `start`, facing as `start` does; nothing when too
/// few points are near or they do not span a plane.
///
/// The gate is symmetric around the *current* plane and follows it while the fit is repeated; from
/// the second fit on it narrows to four robust standard deviations. A symmetric gate shifts no
/// plane whose noise is symmetric, wherever `start` was.
std::optional<FaceFit> fit_face(
    const std::vector<Eigen::Vector3d>& points,
    const OrientedPlane& start,
    const FaceFitOptions& options);

}  // namespace nvm::eval
