// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>

#include "survey/face.hpp"
#include "survey/patch_grid.hpp"

namespace nvm::survey {

/// Which way is up, within 30 degrees of +z or exactly +z: the direction that most of the map's
/// surface lies across or along, as floors and walls do. Maps that start without an IMU are tilted.
/// `along` is the horizontal direction that most walls run along.
Directions find_directions(const PatchGrid& grid);

}  // namespace nvm::survey
