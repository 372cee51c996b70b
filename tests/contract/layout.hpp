// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>

#include "nvm/geometry/trajectory.hpp"
#include "nvm/nvm.hpp"

namespace nvm::test {

struct Layout {
  const char* type;
  std::size_t size;
  std::size_t alignment;
};

// Constants, so that no function of the AVX2 translation unit ever runs.
#define NVM_TEST_LAYOUT(Type) \
  { #Type, sizeof(Type), alignof(Type) }
#define NVM_TEST_PUBLIC_LAYOUTS                                                                   \
  {                                                                                               \
    NVM_TEST_LAYOUT(Pose), NVM_TEST_LAYOUT(StampedPose), NVM_TEST_LAYOUT(Neighbor),               \
        NVM_TEST_LAYOUT(NearestSearch), NVM_TEST_LAYOUT(MapOptions), NVM_TEST_LAYOUT(InsertStats) \
  }

inline constexpr std::size_t kLayoutCount = 6;
extern const Layout kBaselineLayouts[kLayoutCount];
extern const Layout kAvx2Layouts[kLayoutCount];

}  // namespace nvm::test
