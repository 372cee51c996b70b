// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>

#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

/// Places of the error state's parts. Those that a LiDAR point measures come first.
enum NavIndex : int {
  kPosition = 0,        ///< [m], world frame
  kRotation = 3,        ///< [rad], body frame: R Exp(.)
  kVelocity = 6,        ///< [m/s], world frame
  kGyroBias = 9,        ///< [rad/s]
  kLidarPosition = 12,  ///< extrinsic [m], body frame
  kLidarRotation = 15,  ///< extrinsic [rad], LiDAR frame
  kAccelBias = 18,      ///< [m/s^2]
  kGravity = 21,        ///< direction on S2, two tangent coordinates
  kNavSize = 23,
  kMeasuredSize = 18,  ///< size of the part that a LiDAR point measures
};

using NavVector = Eigen::Matrix<double, kNavSize, 1>;
using NavCovariance = Eigen::Matrix<double, kNavSize, kNavSize, Eigen::DontAlign>;

/// State of the body (IMU) frame B in the world frame W, with all that the IMU readings need.
struct NavState {
  double time = 0.0;  ///< [s]
  Pose T_world_body = Pose::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();    ///< [m/s], world frame
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();   ///< [rad/s]
  Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();  ///< [m/s^2]
  Eigen::Vector3d gravity = {0.0, 0.0, -9.81};           ///< [m/s^2], world frame, fixed length
  Pose T_body_lidar = Pose::Identity();                  ///< extrinsic

  Pose T_world_lidar() const { return T_world_body * T_body_lidar; }
};

/// Two unit vectors that span the plane orthogonal to `direction`: the tangent space of S2. The
/// basis turns smoothly with the direction except at -z's antipode, +z.
Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& direction);

/// `state` [+] `error`: each part by its own group's exponential.
NavState boxplus(const NavState& state, const NavVector& error);

/// The error with boxplus(reference, error) = state.
NavVector boxminus(const NavState& state, const NavState& reference);

/// Derivative of boxminus(boxplus(state, e), reference) to e at e = 0: how an error at `state`
/// looks from `reference`.
Eigen::Matrix<double, kNavSize, kNavSize> boxminus_jacobian(
    const NavState& state, const NavState& reference);

}  // namespace nvm::lio
