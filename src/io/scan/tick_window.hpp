// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <vector>

namespace nvm::io {

/// Some of the ascending times of one scan: the first and the last of them, and how many there are.
struct TickWindow {
  double first = 0.0;
  double last = 0.0;
  std::size_t count = 0;
};

/// The interval of `length` that holds the most of the ascending `ticks`.
TickWindow densest_window(const std::vector<double>& ticks, double length);

/// The interval of the four fifths of the ascending `ticks` that lie closest together, widened by
/// what lies next to them. `ticks` must not be empty.
TickWindow main_part(const std::vector<double>& ticks);

/// Makes times that wrap at `modulus` contiguous: when those of one scan lie more than half of it
/// apart, or all in its upper half, the upper ones are negative. No change for modulus 0.
void unwrap(std::vector<double>& ticks, double modulus);

/// The median distance from the median. `values` must not be empty.
double spread(std::vector<double> values);

}  // namespace nvm::io
