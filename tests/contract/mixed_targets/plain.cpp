// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "contract/mixed_targets/work.hpp"

namespace nvm::test {

Work plain_work(VoxelMap& shared, bool normals) { return work(shared, normals); }

}  // namespace nvm::test
