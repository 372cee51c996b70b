// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"

namespace nvm::io {

/// Keeps a topic to sweeps that follow one another where they overlap: two LiDARs of one frame may
/// publish on it, or one that sends each point in two clouds.
class SweepOverlap {
 public:
  /// Judges by the first sweeps, in the order in which they came. Returns what to say, "" where
  /// they follow one another.
  std::string learn(const std::vector<Scan>& first);

  /// Takes the next sweep. Throws std::runtime_error for one that overlaps the one kept last,
  /// where the first ones did: stamps that jitter make single sweeps of any LiDAR overlap. Time may
  /// go back by more than two sweeps, and all begins anew.
  void check(const Scan& scan);

 private:
  bool is_watched_ = false;
  double kept_until_ = -std::numeric_limits<double>::infinity();  // [s]
};

}  // namespace nvm::io
