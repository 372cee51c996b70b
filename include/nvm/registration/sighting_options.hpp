// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "nvm/core/finite.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/registration/plane.hpp"

namespace nvm {

/// When a plane of map points is the surface that a point without a plane of its own lies on. Such
/// a point may lie on anything: what is no surface must not pass for one.
struct SightingOptions {
  /// Less planar neighbours (a2D of spec §4) are a pole, an edge or a single ring, 0 to 1.
  double min_planarity = 0.4;
  /// Neighbours that deviate more from the plane (one standard deviation) are foliage, or the two
  /// faces of an edge [m], positive.
  double max_deviation = 0.02;
  /// Sine of the angle between the view direction and the plane. Below it the plane may be seen
  /// from either side, 0 to 1.
  double min_incidence_sine = 0.1;

  /// Whether `plane` is the surface of a point with this sighting (nvm/map/sighting.hpp), in the
  /// frame of the plane.
  NVM_SHARED bool accept(const Plane& plane, const Eigen::Vector3f& sighting) const {
    const double sine = 2.0 * std::abs(detail::dot(plane.normal, detail::cast<double>(sighting)));
    return plane.planarity >= min_planarity && plane.deviation[0] <= max_deviation &&
           sine >= min_incidence_sine;
  }

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  NVM_SHARED void validate() const {
    require(min_planarity >= 0.0 && min_planarity <= 1.0, "min_planarity", min_planarity, "0 to 1");
    require(
        max_deviation > 0.0 && detail::is_finite(max_deviation),
        "max_deviation",
        max_deviation,
        "positive [m]");
    require(
        min_incidence_sine >= 0.0 && min_incidence_sine <= 1.0,
        "min_incidence_sine",
        min_incidence_sine,
        "0 to 1");
  }
};

}  // namespace nvm
