// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "eval/walls/oriented_cloud.hpp"
#include "eval/walls/region.hpp"
#include "eval/walls/side_purity.hpp"
#include "eval/walls/wall.hpp"

namespace nvm::eval {

/// A point of a wall seen along the wall.
struct SectionPoint {
  double along = 0.0;   ///< from the middle of the wall, along it [m]
  double across = 0.0;  ///< from the middle of the true wall, along the first face's normal [m]
  int side = 0;         ///< the face that the point is counted to, 0 or 1
};

/// What a map makes of one wall.
struct WallEvaluation {
  std::string name;
  std::optional<double> true_thickness;  ///< [m]; nothing for a region of unknown thickness
  bool is_seen = true;                   ///< the sensor saw enough of both faces
  std::optional<double> thickness;       ///< [m]; nothing when a face was not found in the map
  double standard_error = 0.0;           ///< of `thickness` [m]
  double spread = 0.0;                   ///< RMS distance of the points to their own face [m]
  std::array<std::size_t, 2> points{};   ///< that the two faces were fitted to
  SideCount sides;                       ///< empty where sides are unknown
  std::vector<SectionPoint> section;     ///< of the piece with most points, thinned

  /// thickness - true_thickness [m].
  std::optional<double> error() const;
};

/// How walls are evaluated.
struct WallOptions {
  WallPointOptions points;
  FaceFitOptions fit;
  std::size_t min_hits = 500;  ///< fewer true returns on a face: the wall was not seen from there
};

/// Evaluates the walls that `pieces` make up on `cloud` (world frame). The pieces of a wall are
/// measured one by one; the wall has their mean, weighted by their points.
std::vector<WallEvaluation> evaluate_walls(
    const OrientedCloud& cloud, const std::vector<WallPiece>& pieces, const WallOptions& options);

/// Evaluates the wall in `region`, whose frame is that of `cloud`. Sides are not counted.
WallEvaluation evaluate_region(
    const OrientedCloud& cloud, const Region& region, const WallOptions& options);

}  // namespace nvm::eval
