// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "lio/imu/motion_history.hpp"

namespace nvm::lio {

/// The motion at the last pose of a history, by the poses and the accelerometer.
struct MotionFit {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   ///< [m/s], map frame
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();    ///< [m/s^2], map frame, of any length
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();  ///< [rad/s]
  /// What makes m/s^2 of the readings, negative where their sign is wrong, and how sure that is:
  /// one standard deviation.
  double accel_scale = 1.0;
  double accel_scale_deviation = 0.0;
  double position_rms = 0.0;  ///< of the poses from the fit [m]
};

/// Fits p(t) = p0 + v0 t + g t^2 / 2 + s A(t) to the poses of the last `duration` [s], A being the
/// specific force integrated twice: the linear alignment of visual-inertial initialisation (Qin, Li
/// and Shen, VINS-Mono, T-RO 2018) with the attitude that the scans tell. The scale s is
/// `assumed_scale`, or is estimated when that is zero; `accel_bias` [m/s^2] is taken off the
/// readings first. Nothing when there are too few poses or the readings do not cover them.
std::optional<MotionFit> fit_motion(
    const MotionHistory& history,
    double duration,
    double assumed_scale,
    const Eigen::Vector3d& accel_bias = Eigen::Vector3d::Zero());

}  // namespace nvm::lio
