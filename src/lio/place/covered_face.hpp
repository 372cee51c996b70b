// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>

#include "nvm/map/voxel_map.hpp"

namespace nvm::lio {

/// Whether `map` has a face at `foot` [m], with unit normal `normal`: points that lie in its plane,
/// face the same way and stand all around. At the edge of a face, where it may end, it says no.
bool is_covered(
    const VoxelMap& map,
    const Eigen::Vector3d& foot,
    const Eigen::Vector3f& normal,
    VoxelMap::QueryContext& context);

}  // namespace nvm::lio
