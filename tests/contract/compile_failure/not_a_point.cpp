// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/nvm.hpp"

struct Cartesian {
  double east, north, up;
};

auto p = nvm::position(Cartesian{1.0, 2.0, 3.0});
