// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <optional>

#include "eval/walls/oriented_plane.hpp"
#include "eval/walls/wall_points.hpp"

namespace nvm::eval {

/// A wall as the map has it.
struct Thickness {
  double value = 0.0;           ///< [m]; negative when the faces lie behind each other
  double standard_error = 0.0;  ///< of `value` [m], from the points' spread and number alone
  std::array<FaceFit, 2> faces;
};

/// The thickness of the wall with these points (spec §6): the mean distance of one face's points to
/// the plane fitted to the other's, averaged over which face has the plane. Distances are signed,
/// since absolute ones would fold noise into thickness. Nothing when a face cannot be fitted.
///
/// `start` tells roughly where the faces are (see fit_face).
std::optional<Thickness> measure_thickness(
    const SidedPoints& points,
    const std::array<OrientedPlane, 2>& start,
    const std::array<FaceFitOptions, 2>& options);

}  // namespace nvm::eval
