// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <functional>

#include "common/sensor_data.hpp"
#include "lio/state/imu_noise.hpp"
#include "lio/state/motion_segment.hpp"
#include "lio/state/nav_state.hpp"

namespace nvm::lio {

/// Part of the error state that LiDAR points measure.
using MeasuredVector = Eigen::Matrix<double, kMeasuredSize, 1>;
using MeasuredMatrix = Eigen::Matrix<double, kMeasuredSize, kMeasuredSize, Eigen::DontAlign>;

/// What a set of residuals z(x [+] e) = z + H e with weights W says: H^T W H and H^T W z.
struct Information {
  MeasuredMatrix matrix = MeasuredMatrix::Zero();
  Eigen::Matrix<double, kMeasuredSize, 1, Eigen::DontAlign> vector =
      Eigen::Matrix<double, kMeasuredSize, 1, Eigen::DontAlign>::Zero();
};

/// Adds up the information of the residuals at `state`. `associate` asks for new correspondences;
/// otherwise the last ones are evaluated again. False when there are too few to use.
using Linearizer = std::function<bool(const NavState& state, bool associate, Information& out)>;

struct IterationOptions {
  /// Evaluations of the residuals at most, 1 to 50.
  int max_iterations = 6;
  /// An iteration that moves the pose by less counts as converged [m], [rad].
  double max_converged_translation = 2e-4;
  double max_converged_rotation = 5e-5;

  void validate() const;
};

struct UpdateResult {
  bool applied =
      false;  ///< false: the linearizer refused, state and covariance are the predicted ones
  bool converged = false;
  int iterations = 0;
};

/// Iterated error-state Kalman filter on the manifold of NavState.
///
/// Prediction integrates IMU readings; correction is the iterated update in information form
/// (FAST-LIO, Xu and Zhang 2021, Eq. 14 to 20), written so that no covariance is inverted:
/// with P' = J^-1 P J^-T the step is -(I + P' H^T W H)^-1 (J^-1 (x [-] x_predicted) + P' H^T W z).
/// A part of the state with zero variance, the extrinsic by default, therefore stays as it is.
class ErrorStateFilter {
 public:
  ErrorStateFilter(const NavState& state, const NavCovariance& covariance, const ImuNoise& noise);

  const NavState& state() const { return state_; }
  const NavCovariance& covariance() const { return covariance_; }

  /// Moves the state from `a` to `b`, two consecutive readings, a.time being the state's time.
  /// Returns the motion on the way.
  MotionSegment predict(const ImuSample& a, const ImuSample& b);

  /// Moves the state to `time` [s] without IMU data: at constant velocity and turning at `rate`
  /// [rad/s, body frame], with the uncertainty of a hand-held sensor's acceleration and turning.
  /// Returns the motion on the way.
  MotionSegment coast(double time, const Eigen::Vector3d& rate);

  /// Takes it that the body rests (zero-velocity update), `mean_gyro` [rad/s] being what the
  /// gyroscope reads.
  void observe_rest(const Eigen::Vector3d& mean_gyro);

  UpdateResult update(const Linearizer& linearize, const IterationOptions& options);

  /// Takes `T_world_body` as a measurement of the pose: `covariance` of (position [m^2, world
  /// frame], rotation [rad^2, body frame]).
  void observe_pose(
      const Pose& T_world_body, const Eigen::Matrix<double, 6, 6, Eigen::DontAlign>& covariance);

 private:
  template <int kSize>
  void observe(
      int part,
      const Eigen::Matrix<double, kSize, 1>& innovation,
      const Eigen::Matrix<double, kSize, kSize>& covariance);

  NavState state_;
  NavCovariance covariance_;
  ImuNoise noise_;
};

}  // namespace nvm::lio
