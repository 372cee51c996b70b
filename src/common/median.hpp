// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "nvm/core/assert.hpp"

namespace nvm {

/// Of an even number of values the mean of the two in the middle. `values` must not be empty.
inline double median(std::vector<double> values) {
  NVM_ASSERT(!values.empty());
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  return values.size() % 2 == 1 ? *upper
                                : 0.5 * (*upper + *std::max_element(values.begin(), upper));
}

}  // namespace nvm
