// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "contract/layout.hpp"

#include <gtest/gtest.h>

namespace nvm::test {
namespace {

TEST(Contract, PublicStructsHaveOneLayoutWhateverTheInstructionSet) {
  for (std::size_t i = 0; i < kBaselineLayouts.size(); ++i) {
    SCOPED_TRACE(kBaselineLayouts[i].type);
    EXPECT_EQ(kBaselineLayouts[i].size, kAvx2Layouts[i].size);
    EXPECT_EQ(kBaselineLayouts[i].alignment, kAvx2Layouts[i].alignment);
  }
}

}  // namespace
}  // namespace nvm::test
