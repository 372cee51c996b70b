// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>

#include "nvm/geometry/trajectory.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::test {

struct Layout {
  const char* type;
  std::size_t size;
  std::size_t alignment;
};
using Layouts = std::array<Layout, 14>;

// Constants, so that no function of the AVX2 translation unit ever runs.
extern const Layouts kBaselineLayouts;
extern const Layouts kAvx2Layouts;

}  // namespace nvm::test

// clang-format off
#define NVM_TEST_LAYOUT(Type) nvm::test::Layout{#Type, sizeof(Type), alignof(Type)}
#define NVM_TEST_PUBLIC_LAYOUTS \
  {{ \
    NVM_TEST_LAYOUT(nvm::Pose), \
    NVM_TEST_LAYOUT(nvm::StampedPose), \
    NVM_TEST_LAYOUT(nvm::NormalOptions), \
    NVM_TEST_LAYOUT(nvm::NormalResult), \
    NVM_TEST_LAYOUT(nvm::NormalEstimator), \
    NVM_TEST_LAYOUT(nvm::MapOptions), \
    NVM_TEST_LAYOUT(nvm::InsertStats), \
    NVM_TEST_LAYOUT(nvm::NearestSearch), \
    NVM_TEST_LAYOUT(nvm::Neighbor), \
    NVM_TEST_LAYOUT(nvm::MapPoint), \
    NVM_TEST_LAYOUT(nvm::VoxelMap), \
    NVM_TEST_LAYOUT(nvm::AlignOptions), \
    NVM_TEST_LAYOUT(nvm::AlignResult), \
    NVM_TEST_LAYOUT(nvm::ScanAligner<nvm::VoxelMap>), \
  }}
// clang-format on
