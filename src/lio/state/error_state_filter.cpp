// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/state/error_state_filter.hpp"

#include <Eigen/LU>
#include <cmath>

#include "nvm/core/require.hpp"

namespace nvm::lio {

namespace {

using NavMatrix = Eigen::Matrix<double, kNavSize, kNavSize>;

void add_noise(NavCovariance& P, NavIndex part, double density, double dt) {
  P.diagonal().segment<3>(part).array() += density * density * dt;
}

/// Changes of a hand-held sensor's motion that an absent IMU would have seen.
constexpr double kCoastGyro = 1.0;   // [rad/s/sqrt(Hz)]
constexpr double kCoastAccel = 2.0;  // [m/s^2/sqrt(Hz)]

/// How much a body at rest may still move.
constexpr double kRestVelocity = 0.005;  // [m/s]
constexpr double kRestRate = 0.003;      // [rad/s]

void symmetrize(NavCovariance& P) { P = (0.5 * (P + P.transpose())).eval(); }

}  // namespace

ErrorStateFilter::ErrorStateFilter(
    const NavState& state, const NavCovariance& covariance, const ImuNoise& noise)
    : state_(state), covariance_(covariance), noise_(noise) {
  noise.validate();
}

MotionSegment ErrorStateFilter::predict(const ImuSample& a, const ImuSample& b) {
  const double dt = b.time - a.time;
  const Eigen::Vector3d rate = 0.5 * (a.gyro + b.gyro) - state_.gyro_bias;
  const Eigen::Matrix3d R = state_.T_world_body.linear();
  const Eigen::Matrix3d turn = so3_exp(dt * rate);
  const Eigen::Vector3d force_a = a.accel - state_.accel_bias;
  const Eigen::Vector3d force_b = b.accel - state_.accel_bias;
  const Eigen::Vector3d force_world = 0.5 * (R * force_a + R * (turn * force_b));
  const Eigen::Vector3d acceleration = force_world + state_.gravity;

  NavMatrix F = NavMatrix::Identity();
  const Eigen::Matrix3d dv_drotation = -dt * skew(force_world) * R;
  const Eigen::Matrix<double, 3, 2> dv_dgravity =
      -dt * skew(state_.gravity) * tangent_basis(state_.gravity);
  F.block<3, 3>(kPosition, kVelocity) = dt * Eigen::Matrix3d::Identity();
  F.block<3, 3>(kPosition, kRotation) = 0.5 * dt * dv_drotation;
  F.block<3, 3>(kPosition, kAccelBias) = -0.5 * dt * dt * R;
  F.block<3, 2>(kPosition, kGravity) = 0.5 * dt * dv_dgravity;
  F.block<3, 3>(kRotation, kRotation) = turn.transpose();
  F.block<3, 3>(kRotation, kGyroBias) = -dt * Eigen::Matrix3d::Identity();
  F.block<3, 3>(kVelocity, kRotation) = dv_drotation;
  F.block<3, 3>(kVelocity, kAccelBias) = -dt * R;
  F.block<3, 2>(kVelocity, kGravity) = dv_dgravity;
  covariance_ = (F * covariance_ * F.transpose()).eval();
  add_noise(covariance_, kRotation, std::hypot(noise_.gyro, noise_.gyro_scale * rate.norm()), dt);
  add_noise(covariance_, kVelocity, noise_.accel, dt);
  add_noise(covariance_, kGyroBias, noise_.gyro_bias, dt);
  add_noise(covariance_, kAccelBias, noise_.accel_bias, dt);

  const MotionSegment motion{a.time, state_.T_world_body, state_.velocity, rate, acceleration};
  state_.T_world_body.translation() += dt * state_.velocity + 0.5 * dt * dt * acceleration;
  state_.T_world_body.linear() = R * turn;
  state_.velocity += dt * acceleration;
  state_.time = b.time;
  return motion;
}

MotionSegment ErrorStateFilter::coast(double time, const Eigen::Vector3d& rate) {
  const double dt = time - state_.time;
  NavMatrix F = NavMatrix::Identity();
  F.block<3, 3>(kPosition, kVelocity) = dt * Eigen::Matrix3d::Identity();
  covariance_ = (F * covariance_ * F.transpose()).eval();
  add_noise(covariance_, kRotation, kCoastGyro, dt);
  add_noise(covariance_, kVelocity, kCoastAccel, dt);
  covariance_.diagonal().segment<3>(kPosition).array() +=
      kCoastAccel * kCoastAccel * dt * dt * dt / 3.0;
  const MotionSegment motion{
      state_.time, state_.T_world_body, state_.velocity, rate, Eigen::Vector3d::Zero()};
  state_.T_world_body = motion.pose_at(time);
  state_.time = time;
  return motion;
}

UpdateResult ErrorStateFilter::update(
    const Linearizer& linearize, const IterationOptions& options) {
  const NavState predicted = state_;
  const NavCovariance P = covariance_;
  UpdateResult result;
  bool associate = true;
  int convergences = 0;
  while (result.iterations < options.max_iterations && convergences < 2) {
    Information information;
    if (!linearize(state_, associate, information)) {
      state_ = predicted;
      covariance_ = P;
      return UpdateResult{false, false, result.iterations};
    }
    const NavMatrix J_inverse = boxminus_jacobian(state_, predicted).inverse();
    const NavMatrix P_here = J_inverse * P * J_inverse.transpose();
    NavMatrix S = NavMatrix::Identity();
    S.leftCols<kMeasuredSize>() += P_here.leftCols<kMeasuredSize>() * information.matrix;
    const Eigen::PartialPivLU<NavMatrix> lu(S);
    const NavVector step = -lu.solve(
        J_inverse * boxminus(state_, predicted) +
        P_here.leftCols<kMeasuredSize>() * information.vector);
    state_ = boxplus(state_, step);
    covariance_ = lu.solve(P_here);
    ++result.iterations;
    const bool small = step.segment<3>(kPosition).norm() < options.max_converged_translation &&
                       step.segment<3>(kRotation).norm() < options.max_converged_rotation;
    convergences += small ? 1 : 0;
    // New correspondences where the old ones have nothing more to say, and once before giving up.
    associate = small || result.iterations + 2 == options.max_iterations;
  }
  symmetrize(covariance_);
  result.applied = true;
  result.converged = convergences > 0;
  return result;
}

template <int kSize>
void ErrorStateFilter::observe(
    int part,
    const Eigen::Matrix<double, kSize, 1>& innovation,
    const Eigen::Matrix<double, kSize, kSize>& covariance) {
  const Eigen::Matrix<double, kSize, kNavSize> HP = covariance_.middleRows<kSize>(part);
  const Eigen::Matrix<double, kSize, kSize> S = HP.template middleCols<kSize>(part) + covariance;
  const Eigen::Matrix<double, kNavSize, kSize> K = S.ldlt().solve(HP).transpose();
  state_ = boxplus(state_, K * innovation);
  covariance_ = (covariance_ - K * HP).eval();
  symmetrize(covariance_);
}

void ErrorStateFilter::observe_pose(
    const Pose& T_world_body, const Eigen::Matrix<double, 6, 6, Eigen::DontAlign>& covariance) {
  Eigen::Matrix<double, 6, 1> innovation;
  innovation << T_world_body.translation() - state_.T_world_body.translation(),
      so3_log(state_.T_world_body.linear().transpose() * T_world_body.linear());
  observe<6>(kPosition, innovation, covariance);
}

void ErrorStateFilter::observe_rest(const Eigen::Vector3d& mean_gyro) {
  observe<3>(
      kVelocity, -state_.velocity, kRestVelocity * kRestVelocity * Eigen::Matrix3d::Identity());
  observe<3>(
      kGyroBias, mean_gyro - state_.gyro_bias, kRestRate * kRestRate * Eigen::Matrix3d::Identity());
}

void ImuNoise::validate() const {
  const auto positive = [](double value, const char* name) {
    require(value > 0.0 && std::isfinite(value), name, value, "positive");
  };
  positive(gyro, "imu gyro noise");
  positive(accel, "imu accel noise");
  positive(gyro_bias, "imu gyro bias walk");
  positive(accel_bias, "imu accel bias walk");
  require(
      gyro_scale >= 0.0 && std::isfinite(gyro_scale),
      "imu gyro scale noise",
      gyro_scale,
      "0 or more");
}

void IterationOptions::validate() const {
  require(max_iterations >= 1 && max_iterations <= 50, "max_iterations", max_iterations, "1 to 50");
  require(
      max_converged_translation > 0.0,
      "max_converged_translation",
      max_converged_translation,
      "positive [m]");
  require(
      max_converged_rotation > 0.0,
      "max_converged_rotation",
      max_converged_rotation,
      "positive [rad]");
}

}  // namespace nvm::lio
