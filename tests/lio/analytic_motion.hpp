// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "common/sensor_data.hpp"
#include "lio/state/nav_state.hpp"

namespace nvm::test {

/// A smooth motion in closed form: at rest until `start` [s], then swaying and turning like a
/// hand-held sensor. Derivatives by central differences, exact to 1e-7.
struct AnalyticMotion {
  double start = 1.5;
  double sway = 1.0;     ///< amplitude of the slow translation [m]
  double turning = 0.6;  ///< amplitude of the slow rotation [rad]
  double spin = 0.0;  ///< amplitude of fast turns about z, at up to 2.3 times that a second [rad]

  Pose pose(double t) const {
    const double s = smooth(t);
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(
        sway * std::sin(0.7 * s) + 0.02 * std::sin(9.0 * s),
        sway * (1.0 - std::cos(0.5 * s)),
        0.1 * std::sin(1.1 * s) + 0.015 * std::sin(11.0 * s));
    const double yaw = turning * std::sin(0.6 * s) + spin * std::pow(std::sin(2.0 * s), 3);
    pose.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(0.1 * std::sin(1.3 * s), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(0.08 * std::sin(1.7 * s), Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    return pose;
  }

  Eigen::Vector3d velocity(double t) const {
    return (pose(t + kStep).translation() - pose(t - kStep).translation()) / (2.0 * kStep);
  }

  ImuSample imu(double t) const {
    const Pose now = pose(t);
    const Pose before = pose(t - kStep);
    const Pose after = pose(t + kStep);
    const Eigen::Vector3d acceleration =
        (after.translation() - 2.0 * now.translation() + before.translation()) / (kStep * kStep);
    const Eigen::Vector3d gravity(0.0, 0.0, -9.81);
    return {
        t,
        so3_log(before.linear().transpose() * after.linear()) / (2.0 * kStep),
        now.linear().transpose() * (acceleration - gravity)};
  }

  lio::NavState state(double t) const {
    lio::NavState state;
    state.time = t;
    state.T_world_body = pose(t);
    state.velocity = velocity(t);
    return state;
  }

 private:
  static constexpr double kStep = 1e-4;

  /// Time since the start, eased in over a second so that acceleration is continuous.
  double smooth(double t) const {
    const double s = t - start;
    if (s <= 0.0) {
      return 0.0;
    }
    return s < 1.0 ? s * s * s * s * (2.5 - 3.0 * s + s * s) : s - 0.5;
  }
};

}  // namespace nvm::test
