// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>

#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

/// The motion from one IMU reading to the next: constant rate and constant acceleration.
struct MotionSegment {
  double time = 0.0;                                       ///< of its beginning [s]
  Pose T_world_body = Pose::Identity();                    ///< at its beginning
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< at its beginning [m/s], world
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();          ///< [rad/s], body
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< [m/s^2], world

  /// The pose at time `t` [s].
  Pose pose_at(double t) const {
    const double s = t - time;
    Pose pose = T_world_body;
    pose.linear() *= so3_exp(s * rate);
    pose.translation() += s * velocity + 0.5 * s * s * acceleration;
    return pose;
  }
};

}  // namespace nvm::lio
