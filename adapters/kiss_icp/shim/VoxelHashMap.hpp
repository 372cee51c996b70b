// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// Takes the place of kiss_icp/core/VoxelHashMap.hpp. docs/adapters/kiss_icp.md
#include <sophus/se3.hpp>

#include "adapters/kiss_icp/kiss_map.hpp"

// The host's header brings this one along, and its pipeline relies on that.
#if __has_include("VoxelUtils.hpp")
#include "VoxelUtils.hpp"
#endif

namespace kiss_icp {

struct VoxelHashMap : nvm::adapters::KissMap<Sophus::SE3d> {
  using KissMap::KissMap;
};

}  // namespace kiss_icp
