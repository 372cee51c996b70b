// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "nvm/core/finite.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// A rigid transform T_a_b that maps coordinates of frame b to frame a. DontAlign, because the
/// alignment of Eigen::Isometry3d depends on -march and would make it part of every user's ABI.
using Pose = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

}  // namespace NVM_TARGET
namespace detail {
inline namespace NVM_TARGET {

/// Pose::Identity(), for functions that are no templates. Out of its coefficients, because Eigen
/// has expressions in each of its ways to make one (coordinates.hpp).
inline Pose identity() {
  static_assert(sizeof(Pose) == 16 * sizeof(double));
  const double columns[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  alignas(Pose) unsigned char pose[sizeof(Pose)];
  std::memcpy(pose, columns, sizeof(pose));
  return *reinterpret_cast<const Pose*>(pose);
}

}  // namespace NVM_TARGET
}  // namespace detail
inline namespace NVM_TARGET {

/// A copy of the rotation R_a_b.
inline Eigen::Matrix3d rotation_of(const Pose& T_a_b) {
  Eigen::Matrix3d R;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      R(i, j) = T_a_b(i, j);
    }
  }
  return R;
}

/// Skew-symmetric matrix [v]x with [v]x w = v x w.
template <class = void>
Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

// Those that need more of Eigen are templates on what they are given (coordinates.hpp).

/// Rotation by the vector `rotation` [rad], any expression or { x, y, z }: Exp: R^3 -> SO(3). Exact
/// for the zero vector.
template <class Vector = Eigen::Vector3d>
Eigen::Matrix3d so3_exp(const Vector& rotation) {
  using Real = typename Vector::Scalar;
  const Eigen::Matrix<Real, 3, 1> v = rotation;
  const double angle = v.norm();
  const double half_sinc =
      angle < 1e-8 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  const Eigen::Quaternion<Real> q(
      std::cos(0.5 * angle), half_sinc * v.x(), half_sinc * v.y(), half_sinc * v.z());
  return q.normalized().toRotationMatrix();
}

/// Rotation vector [rad] of `rotation`, of length at most pi: Log: SO(3) -> R^3.
template <class Matrix>
Eigen::Vector3d so3_log(const Matrix& rotation) {
  using Real = typename Matrix::Scalar;
  const Eigen::Matrix<Real, 3, 3> R = rotation;
  Eigen::Quaternion<Real> q(R);
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
  const auto column = [&pose](int j) {
    return detail::per_axis([&](int axis) { return pose(axis, j); });
  };
  double error = 0.0;  // of R^T R
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double dot = detail::dot(column(i), column(j));
      error = std::max(error, std::abs(dot - (i == j ? 1.0 : 0.0)));
    }
  }
  return error <= tolerance && detail::dot(detail::cross(column(0), column(1)), column(2)) > 0.0;
}

}  // namespace NVM_TARGET
}  // namespace nvm
