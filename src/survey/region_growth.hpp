// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <vector>

#include "eval/walls/oriented_plane.hpp"
#include "survey/patch_grid.hpp"

namespace nvm::survey {

/// Patches that lie on one plane and look its way.
struct PlanarRegion {
  eval::OrientedPlane plane;
  std::vector<std::uint32_t> patches;
  PlaneSums sums;
};

/// How far off a plane the points of a patch may lie on average [m].
struct GrowthGates {
  double growing = 0.025;  ///< while the plane is not yet known well
  double final = 0.012;    ///< once it is
};

/// The planar regions that connected patches form, in order of their seeds: patches with most
/// points first. Each patch belongs to one region at most; those that belong to none are clutter,
/// curved or alone.
///
/// A region grows from a patch over its neighbours whose normals look the plane's way and whose
/// points lie on it; the plane follows, and when nothing is left to add, the region is gathered
/// once more with the plane that came out.
std::vector<PlanarRegion> grow_regions(const PatchGrid& grid, const GrowthGates& gates);

}  // namespace nvm::survey
