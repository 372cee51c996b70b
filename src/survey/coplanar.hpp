// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "survey/region_growth.hpp"

namespace nvm::survey {

/// What regions may be joined across.
struct JoinLimits {
  double max_gap = 1.6;  ///< in the plane [m]
  double noise = 0.0;    ///< of the map's points [m]
};

/// Joins regions that lie on one plane within max_gap of each other, as the two sides of a
/// door and what is seen beside a cupboard; larger ones first. Regions that are off each other's
/// plane by more than 2 mm and the noise, or that one plane fits worse than one each by that much
/// (RMS), stay apart: walls of two thicknesses next to each other are two walls.
std::vector<PlanarRegion> join_coplanar(
    const PatchGrid& grid, std::vector<PlanarRegion> regions, const JoinLimits& limits);

}  // namespace nvm::survey
