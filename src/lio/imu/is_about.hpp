// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>

namespace nvm::lio {

/// Whether `value` is within a share of what is expected.
inline bool is_about(double value, double expected, double share) {
  return std::abs(value - expected) <= share * std::abs(expected);
}

}  // namespace nvm::lio
