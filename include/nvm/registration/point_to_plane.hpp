// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Change of a pose T_map_scan: (rotation [rad] in the scan frame, translation [m] in the map
/// frame). DontAlign for the same reason as Pose.
using PoseStep = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;

/// `T_map_scan` changed by `step`: R Exp(step[0:3]), t + step[3:6]. Rotating about the sensor keeps
/// the problem well conditioned wherever the scan lies in the map. The rotation is orthonormal
/// again afterwards: rounding errors would double with each constant-velocity prediction.
template <class Transform, class Step>
Transform retract(const Transform& T_map_scan, const Step& step) {
  Transform result = T_map_scan;
  const Eigen::Quaternion<typename Transform::Scalar> rotation(
      T_map_scan.linear() * so3_exp(step.template head<3>()));
  result.linear() = rotation.normalized().toRotationMatrix();
  result.translation() += step.template tail<3>();
  return result;
}

/// Derivative of n_map . (T p_scan - q) (spec §4) to a PoseStep, for n_scan = R^T n_map.
inline PoseStep point_to_plane_jacobian(
    const Eigen::Vector3d& p_scan, const Eigen::Vector3d& n_scan, const Eigen::Vector3d& n_map) {
  const Eigen::Vector3d arm = detail::cross(p_scan, n_scan);
  PoseStep jacobian;
  for (int axis = 0; axis < 3; ++axis) {
    jacobian[axis] = arm[axis];
    jacobian[axis + 3] = n_map[axis];
  }
  return jacobian;
}

}  // namespace NVM_TARGET
}  // namespace nvm
