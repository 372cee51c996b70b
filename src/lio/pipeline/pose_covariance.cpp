// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/pose_covariance.hpp"

#include <algorithm>
#include <cmath>

#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

}  // namespace

Covariance6 covariance_of(const AlignResult& aligned, const Pose& T_body_lidar) {
  constexpr double kCorrelation = 2.0;    // residuals that count as one: they share map points
  constexpr double kMaxVariance = 100.0;  // [m^2], [rad^2]
  const double sq_deviation = kCorrelation * aligned.rms_distance * aligned.rms_distance;
  PoseMatrix information = aligned.information;
  information.diagonal().array() += std::max(1e-12, sq_deviation / kMaxVariance);
  const Pose T_lidar_body = T_body_lidar.inverse();
  const Eigen::Matrix3d R_map_lidar = aligned.T_map_scan.linear();
  // From (rotation in the scan frame, position of the LiDAR) to (position of the body, rotation
  // about the map's axes).
  Matrix6 to_body = Matrix6::Zero();
  to_body.topLeftCorner<3, 3>() = -skew(R_map_lidar * T_lidar_body.translation()) * R_map_lidar;
  to_body.topRightCorner<3, 3>().setIdentity();
  to_body.bottomLeftCorner<3, 3>() = R_map_lidar;
  return sq_deviation * to_body * information.inverse() * to_body.transpose();
}

void describe_prediction(const NavState& predicted, double duration, FrameResult& result) {
  constexpr double kDoubt = 1.0;       // of a predicted velocity [m/s] and turn rate [rad/s]
  constexpr double kLongest = 1000.0;  // clocks may leap by anything [s]
  result.velocity = predicted.velocity;
  result.angular_rate = -predicted.gyro_bias;
  if (duration <= 0.0) {
    return;
  }
  if (result.pose_covariance.isZero(0.0)) {
    const double doubt = kDoubt * std::min(duration, kLongest);
    result.pose_covariance.diagonal().setConstant(doubt * doubt);
  }
  // The difference of two poses that are about as sure as each other.
  Matrix6 to_twist = Matrix6::Identity();
  to_twist.bottomRightCorner<3, 3>() = result.T_map_body.linear().transpose();
  to_twist *= std::sqrt(2.0) / duration;
  result.twist_covariance = to_twist * result.pose_covariance * to_twist.transpose();
}

void describe_motion(const ErrorStateFilter& filter, const ImuSample* last, FrameResult& result) {
  const NavState& state = filter.state();
  result.velocity = state.velocity;
  if (last != nullptr) {
    result.angular_rate = last->gyro - state.gyro_bias;
  }
  static_assert(kPosition == 0 && kRotation == 3);
  const NavCovariance& covariance = filter.covariance();
  // The filter has the rotation's error in the body frame, R Exp(error).
  Matrix6 to_map = Matrix6::Identity();
  to_map.bottomRightCorner<3, 3>() = state.T_world_body.linear();
  result.pose_covariance = to_map * covariance.topLeftCorner<6, 6>() * to_map.transpose();
  result.twist_covariance.topLeftCorner<3, 3>() = covariance.block<3, 3>(kVelocity, kVelocity);
  result.twist_covariance.bottomRightCorner<3, 3>() = covariance.block<3, 3>(kGyroBias, kGyroBias);
}

}  // namespace nvm::lio
