// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <array>
#include <nvm/nvm.hpp>

// What a stranger's program does first: it reads its own record through nvm.
struct Return {
  float x, y, z;
};

int main() {
  const std::array<Return, 1> scan{{{1.0F, 2.0F, 3.0F}}};
  static_assert(nvm::is_point_range_v<decltype(scan)>);
  return nvm::position(scan[0]) == Eigen::Vector3d(1.0, 2.0, 3.0) ? 0 : 1;
}
