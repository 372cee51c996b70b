// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/range_scale.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/printed.hpp"
#include "lio/imu/is_about.hpp"
#include "lio/imu/motion_fit.hpp"

namespace nvm::lio {

void RangeScale::weigh(const MotionHistory& history, double duration, double gravity) {
  constexpr double kGravityError = 0.03;  // share
  constexpr double kMaxDeviation = 0.3;   // share
  const std::optional<MotionFit> fit = fit_motion(history, duration, 0.0);
  if (!fit || !(fit->accel_scale_deviation < kMaxDeviation * fit->accel_scale) ||
      !is_about(fit->gravity.norm() / fit->accel_scale, gravity, kGravityError)) {
    return;
  }
  factor_.add(fit->accel_scale, 1.0 / (fit->accel_scale_deviation * fit->accel_scale_deviation));
}

std::string RangeScale::finding() const {
  constexpr std::size_t kFewest = 3;
  // Poses of a VLP-16 in small rooms give 0.95 with right ranges.
  constexpr double kMinError = 0.08;
  constexpr double kDeviations = 5.0;
  if (factor_.count() < kFewest) {
    return "";
  }
  const double factor = factor_.mean();
  // Of each motion on its own, and as much more as they differ by more than that.
  const auto freedoms = static_cast<double>(factor_.count() - 1);
  const double excess = std::max(1.0, factor_.variance() * factor_.weight() / freedoms);
  const double deviation = std::sqrt(excess / factor_.weight());
  if (std::abs(factor - 1.0) < std::max(kMinError, kDeviations * deviation)) {
    return "";
  }
  return printed(
      "the scans tell %.3g (+- %.2g) times the motion that the accelerometer feels, and that feels "
      "gravity as it should: the ranges are off by this factor (feet for metres give 3.28), and so "
      "are poses and map; or the LiDAR is not where input.T_imu_lidar has it on the IMU. Let the "
      "LiDAR's driver give metres, calibrate it, or measure that",
      factor,
      2.0 * deviation);
}

}  // namespace nvm::lio
