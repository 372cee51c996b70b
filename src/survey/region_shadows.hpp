// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "survey/region_growth.hpp"

namespace nvm::survey {

/// Drops the regions that lie, for the most part, within 2 cm (or four times the `noise` [m]) in
/// front of or behind a region of at least twice their points that looks the same way: the tails of
/// its noise, or a picture on a wall.
void drop_shadows(const PatchGrid& grid, double noise, std::vector<PlanarRegion>& regions);

}  // namespace nvm::survey
