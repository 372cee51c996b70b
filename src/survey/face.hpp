// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "eval/walls/oriented_plane.hpp"
#include "survey/mask.hpp"
#include "survey/patch_grid.hpp"
#include "survey/plane_frame.hpp"
#include "survey/region_growth.hpp"

namespace nvm::survey {

/// A planar surface of the map, seen from the side that its normal points to.
struct Face {
  eval::OrientedPlane plane;
  PlaneFrame frame;
  PlaneBox box;                       ///< of its points, in `frame`
  std::vector<std::uint32_t> points;  ///< of the cloud
  double rms = 0.0;                   ///< of the points' distances to `plane` [m]
  Mask seen;                          ///< where it has points, small gaps closed
};

/// Directions that frames are laid along; unit vectors across each other.
struct Directions {
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

/// The face that the points of `region` make up: the plane is fitted to the points themselves, with
/// a symmetric gate of four robust standard deviations that follows it. `cell`: edge of the cells
/// of `seen` [m]. Nothing when too little is left.
std::optional<Face> make_face(
    const SurveyCloud& cloud,
    const PatchGrid& grid,
    const PlanarRegion& region,
    const Directions& directions,
    double cell);

}  // namespace nvm::survey
