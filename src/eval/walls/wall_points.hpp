// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "eval/walls/oriented_cloud.hpp"
#include "eval/walls/wall.hpp"

namespace nvm::eval {

/// The points of a wall by the side that they belong to.
using SidedPoints = std::array<std::vector<Eigen::Vector3d>, 2>;

/// How the points of a wall are told from the rest of the map.
struct WallPointOptions {
  double margin = 0.1;                         ///< kept from a face's edges at most [m]
  double max_normal_angle = 0.78539816339745;  ///< to the normal of the face [rad]; 45 degrees
  double reach = 0.15;  ///< a wall's points lie this far outside its true faces at most [m]
};

/// The points of `cloud` (world frame) that belong to `wall`, each to the face whose way its normal
/// points. Position decides whether a point is the wall's, never which side it is on: along the
/// normal, the points of a face may lie as far behind it as in front (by thickness + reach), so
/// that noise is not cut off on one side, however thin the wall.
///
/// In a cloud without normals each point goes to the face that it is nearer to. That needs the
/// truth and folds the noise of thin walls outwards (docs/evaluation.md says by how much).
SidedPoints wall_points(
    const OrientedCloud& cloud, const WallPiece& wall, const WallPointOptions& options);

}  // namespace nvm::eval
