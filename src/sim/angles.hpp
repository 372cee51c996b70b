// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "nvm/geometry/pose.hpp"

namespace nvm::sim {

constexpr double rad(double degrees) { return degrees * (M_PI / 180.0); }

/// Rz(yaw) Ry(pitch) Rx(roll), for angles [rad].
inline Eigen::Matrix3d euler_rotation(double roll, double pitch, double yaw) {
  const double cr = std::cos(roll);
  const double sr = std::sin(roll);
  const double cp = std::cos(pitch);
  const double sp = std::sin(pitch);
  const double cy = std::cos(yaw);
  const double sy = std::sin(yaw);
  Eigen::Matrix3d R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return R;
}

/// The same for roll, pitch and yaw in degrees.
inline Eigen::Matrix3d euler_rotation_deg(const Eigen::Vector3d& angles_deg) {
  return euler_rotation(rad(angles_deg.x()), rad(angles_deg.y()), rad(angles_deg.z()));
}

inline Pose make_pose(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  Pose pose = Pose::Identity();
  pose.linear() = R;
  pose.translation() = t;
  return pose;
}

inline Pose shift(const Eigen::Vector3d& t) { return make_pose(Eigen::Matrix3d::Identity(), t); }

}  // namespace nvm::sim
