// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "lio/imu/motion_history.hpp"

namespace nvm::lio {

/// An accelerometer that feels more or less than gravity at rest is off in scale, or has a bias:
/// which one, only motion tells.
class RestForce {
 public:
  /// `force`: what it feels at rest, body frame, `gravity`: how much that should be [m/s^2].
  void set(const Eigen::Vector3d& force, double gravity);

  /// Weighs the motion of the last `duration` [s] of poses and readings by how well either explains
  /// it. Motions must not overlap in time.
  void weigh(const MotionHistory& history, double duration);

  /// Whether it is off by so much, and motion has not decided yet.
  bool is_open() const;
  /// Once motion has decided for it: what makes m/s^2 of the readings.
  std::optional<double> scale() const;
  /// One line, the readings being multiplied by `used_scale`; empty while it feels gravity.
  std::string finding(double used_scale) const;

 private:
  bool is_off() const;

  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();  ///< that explains the force [m/s^2]
  double force_ = 0.0, gravity_ = 0.0;              ///< [m/s^2]
  double evidence_ = 0.0;  ///< for scale against bias, as logarithm of a ratio of likelihoods
};

}  // namespace nvm::lio
