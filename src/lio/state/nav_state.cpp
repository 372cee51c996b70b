// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/state/nav_state.hpp"

#include <cmath>

namespace nvm::lio {

namespace {

Eigen::Vector3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d axis = from.cross(to);
  const double sine = axis.norm();
  if (sine < 1e-12) {
    return axis / from.squaredNorm();
  }
  return axis * (std::atan2(sine, from.dot(to)) / sine);
}

/// Right Jacobian's inverse of SO(3) at `phi`, to third order: errors between two iterates are
/// small.
Eigen::Matrix3d right_jacobian_inverse(const Eigen::Vector3d& phi) {
  const Eigen::Matrix3d S = skew(phi);
  return Eigen::Matrix3d::Identity() + 0.5 * S + S * S / 12.0;
}

}  // namespace

Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d down(0.0, 0.0, -1.0);
  const Eigen::Vector3d d = direction.normalized();
  const Eigen::Matrix3d S = skew(down.cross(d));
  const Eigen::Matrix3d R =
      Eigen::Matrix3d::Identity() + S + S * S / std::max(1.0 + down.dot(d), 1e-9);
  return R.leftCols<2>();
}

NavState boxplus(const NavState& state, const NavVector& error) {
  NavState result = state;
  result.T_world_body.translation() += error.segment<3>(kPosition);
  result.T_world_body.linear() *= so3_exp(error.segment<3>(kRotation));
  result.velocity += error.segment<3>(kVelocity);
  result.gyro_bias += error.segment<3>(kGyroBias);
  result.T_body_lidar.translation() += error.segment<3>(kLidarPosition);
  result.T_body_lidar.linear() *= so3_exp(error.segment<3>(kLidarRotation));
  result.accel_bias += error.segment<3>(kAccelBias);
  result.gravity =
      so3_exp(tangent_basis(state.gravity) * error.segment<2>(kGravity)) * state.gravity;
  return result;
}

NavVector boxminus(const NavState& state, const NavState& reference) {
  NavVector error;
  error.segment<3>(kPosition) =
      state.T_world_body.translation() - reference.T_world_body.translation();
  error.segment<3>(kRotation) =
      so3_log(reference.T_world_body.linear().transpose() * state.T_world_body.linear());
  error.segment<3>(kVelocity) = state.velocity - reference.velocity;
  error.segment<3>(kGyroBias) = state.gyro_bias - reference.gyro_bias;
  error.segment<3>(kLidarPosition) =
      state.T_body_lidar.translation() - reference.T_body_lidar.translation();
  error.segment<3>(kLidarRotation) =
      so3_log(reference.T_body_lidar.linear().transpose() * state.T_body_lidar.linear());
  error.segment<3>(kAccelBias) = state.accel_bias - reference.accel_bias;
  error.segment<2>(kGravity) = tangent_basis(reference.gravity).transpose() *
                               rotation_between(reference.gravity, state.gravity);
  return error;
}

Eigen::Matrix<double, kNavSize, kNavSize> boxminus_jacobian(
    const NavState& state, const NavState& reference) {
  const NavVector error = boxminus(state, reference);
  Eigen::Matrix<double, kNavSize, kNavSize> J =
      Eigen::Matrix<double, kNavSize, kNavSize>::Identity();
  J.block<3, 3>(kRotation, kRotation) = right_jacobian_inverse(error.segment<3>(kRotation));
  J.block<3, 3>(kLidarRotation, kLidarRotation) =
      right_jacobian_inverse(error.segment<3>(kLidarRotation));
  J.block<2, 2>(kGravity, kGravity) =
      tangent_basis(reference.gravity).transpose() * tangent_basis(state.gravity);
  return J;
}

}  // namespace nvm::lio
