// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "lio/motion_history.hpp"

namespace nvm::lio {

/// Finds milliseconds between the clocks of LiDAR and IMU: how much later the gyroscope turns than
/// the scans do, over the whole run. Poses that lean on the IMU hide a part of it.
class ClockWatch {
 public:
  /// Takes what has turned since `begin` [s]. Stretches must not overlap.
  void look(const MotionHistory& history, double begin);

  /// One line; empty while the clocks agree or nothing has turned enough to tell.
  std::string finding() const;

 private:
  struct Line {
    double begin, end;  ///< offset at the first and the last stretch [s]
  };

  Line fit() const;

  // Sums over the stretches, each with the weight that it is sure: of 1, time, offset, ...
  double first_ = 0.0, last_ = 0.0;  ///< [s]
  double w_ = 0.0, wt_ = 0.0, wo_ = 0.0, wtt_ = 0.0, wto_ = 0.0;
  double before_ = 0.0, after_ = 0.0;  ///< squared differences of turns, without and with offsets
};

}  // namespace nvm::lio
