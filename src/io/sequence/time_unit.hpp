// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

namespace nvm::io {

/// The unit [s] of times of which `step` passes between neighbours, where no more than `longest`
/// [s] can: the largest of 1, 1e-3, 1e-6 and 1e-9 that it can be.
inline double time_unit(double step, double longest) {
  constexpr double kFiner = 1e-3;
  double unit = 1.0;
  while (unit > 1e-9 && step * unit > longest) {
    unit *= kFiner;
  }
  return unit;
}

/// A note for users of a file whose times are not in seconds.
inline std::string time_unit_note(const std::string& file, double unit) {
  const char* name = unit > 1e-4 ? "milliseconds" : unit > 1e-7 ? "microseconds" : "nanoseconds";
  return "the times of " + file + " are taken for " + name + ", by their steps";
}

}  // namespace nvm::io
