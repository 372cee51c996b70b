// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nvm/core/finite.hpp"
#include "nvm/core/target.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// A rigid transform T_a_b that maps coordinates of frame b to frame a. DontAlign, because the
/// alignment of Eigen::Isometry3d depends on -march and would make it part of every user's ABI.
using Pose = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

/// Skew-symmetric matrix [v]x with [v]x w = v x w.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Rotation by the vector `rotation` [rad]: Exp: R^3 -> SO(3). Exact for the zero vector.
inline Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  const double half_sinc =
      angle < 1e-8 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q(
      std::cos(0.5 * angle),
      half_sinc * rotation.x(),
      half_sinc * rotation.y(),
      half_sinc * rotation.z());
  return q.normalized().toRotationMatrix();
}

/// Rotation vector [rad] of `R`, of length at most pi: Log: SO(3) -> R^3.
inline Eigen::Vector3d so3_log(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) {
    q.coeffs() = -q.coeffs();
  }
  const double sin_half = q.vec().norm();
  const double scale = sin_half < 1e-8 ? 2.0 / q.w() : 2.0 * std::atan2(sin_half, q.w()) / sin_half;
  return scale * q.vec();
}

/// True when `pose` is finite and its rotation is orthonormal with determinant +1, each entry of
/// R^T R within `tolerance` of the identity's.
inline bool is_rigid(const Pose& pose, double tolerance = 1e-6) {
  if (!detail::all_finite(pose.matrix())) {
    return false;
  }
  const Eigen::Matrix3d R = pose.linear();
  double error = 0.0;  // of R^T R; written out, because Eigen's products are nobody's own code
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double dot = R(0, i) * R(0, j) + R(1, i) * R(1, j) + R(2, i) * R(2, j);
      error = std::max(error, std::abs(dot - (i == j ? 1.0 : 0.0)));
    }
  }
  return error <= tolerance && R.determinant() > 0.0;
}

}  // namespace NVM_TARGET
}  // namespace nvm
