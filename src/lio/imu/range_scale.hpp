// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "lio/imu/motion_history.hpp"
#include "lio/state/weighted_mean.hpp"

namespace nvm::lio {

/// Notices ranges that are off by a factor: the scans then tell a motion that is as much longer
/// than what the accelerometer feels, though that feels gravity as it should.
class RangeScale {
 public:
  /// Takes the motion of the last `duration` [s] of poses and readings, where gravity is `gravity`
  /// [m/s^2]. Motions must not overlap in time.
  void weigh(const MotionHistory& history, double duration, double gravity);

  /// One line once the factor is clearly another than 1, "" before.
  std::string finding() const;

 private:
  WeightedMean factor_;
};

}  // namespace nvm::lio
