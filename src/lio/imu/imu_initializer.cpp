// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_initializer.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "nvm/core/require.hpp"

namespace nvm::lio {

namespace {

Eigen::Matrix3d levelled(const Eigen::Vector3d& up_body) {
  return Eigen::Quaterniond::FromTwoVectors(up_body, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// How unsure the first state is, one standard deviation per part. The pose is the definition of
/// the world frame and thus exact but for what keeps the covariance regular.
struct InitialDeviations {
  double velocity;
  double gyro_bias;
  double accel_bias;
  double gravity;
};

NavCovariance covariance_of(const InitialDeviations& deviation) {
  NavVector sigma = NavVector::Zero();
  sigma.segment<3>(kPosition).setConstant(1e-5);
  sigma.segment<3>(kRotation).setConstant(1e-5);
  sigma.segment<3>(kVelocity).setConstant(deviation.velocity);
  sigma.segment<3>(kGyroBias).setConstant(deviation.gyro_bias);
  sigma.segment<3>(kAccelBias).setConstant(deviation.accel_bias);
  sigma.segment<2>(kGravity).setConstant(deviation.gravity);
  return sigma.cwiseAbs2().asDiagonal().toDenseMatrix();
}

constexpr InitialDeviations kStill{0.002, 0.003, 0.1, 0.012};
constexpr InitialDeviations kMoving{0.05, 0.01, 0.2, 0.03};

/// At rest the specific force is gravity's opposite: R (a - b_a) + g = 0. That ties the bias of the
/// accelerometer to gravity's direction, though neither is known well alone.
void tie_bias_to_gravity(InitialState& initial) {
  constexpr double kDeviation = 0.003;  // of the mean specific force [m/s^2]
  Eigen::Matrix<double, 3, kNavSize> H = Eigen::Matrix<double, 3, kNavSize>::Zero();
  H.block<3, 3>(0, kAccelBias) = -initial.state.T_world_body.linear();
  H.block<3, 2>(0, kGravity) = -skew(initial.state.gravity) * tangent_basis(initial.state.gravity);
  NavCovariance& P = initial.covariance;
  const Eigen::Matrix3d S =
      H * P * H.transpose() + kDeviation * kDeviation * Eigen::Matrix3d::Identity();
  const Eigen::Matrix<double, 3, kNavSize> HP = H * P;
  P -= HP.transpose() * S.inverse() * HP;
}

/// Sum of squares of the white noise that differences of readings tell: motion changes little from
/// one to the next, when they follow each other quickly. Angular rates and specific forces.
std::pair<double, double> white_noise(const std::vector<ImuSample>& readings) {
  constexpr double kQuick = 0.0105;  // [s]
  double sq_gyro = 0.0;
  double sq_accel = 0.0;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    if (readings[i].time - readings[i - 1].time <= kQuick) {
      sq_gyro += 0.5 * (readings[i].gyro - readings[i - 1].gyro).squaredNorm();
      sq_accel += 0.5 * (readings[i].accel - readings[i - 1].accel).squaredNorm();
    }
  }
  return {sq_gyro, sq_accel};
}

}  // namespace

Stillness judge_stillness(
    const std::vector<ImuSample>& readings, const InitializerOptions& options) {
  Stillness s;
  const double share = 1.0 / static_cast<double>(readings.size());
  for (const ImuSample& reading : readings) {
    s.mean_gyro += share * reading.gyro;
    s.mean_accel += share * reading.accel;
  }
  double sq_gyro = 0.0;
  double sq_accel = 0.0;
  for (const ImuSample& reading : readings) {
    sq_gyro += (reading.gyro - s.mean_gyro).squaredNorm();
    sq_accel += (reading.accel - s.mean_accel).squaredNorm();
  }
  const auto [white_gyro, white_accel] = white_noise(readings);
  s.gyro_deviation = std::sqrt(share * std::max(0.0, sq_gyro - white_gyro));
  s.accel_deviation = std::sqrt(share * std::max(0.0, sq_accel - white_accel));
  s.still = s.gyro_deviation <= options.max_still_gyro &&
            s.accel_deviation <= options.max_still_accel &&
            s.mean_gyro.norm() <= options.max_still_rate;
  return s;
}

void move_to(const Pose& T_map_body, InitialState& initial) {
  constexpr double kPositionDeviation = 0.05;  // [m]
  constexpr double kRotationDeviation = 0.02;  // [rad]
  NavState& state = initial.state;
  const Eigen::Matrix3d R = T_map_body.linear() * state.T_world_body.linear().transpose();
  const Eigen::Vector3d gravity = R * state.gravity;
  NavCovariance turn = NavCovariance::Identity();
  turn.block<3, 3>(kPosition, kPosition) = R;
  turn.block<3, 3>(kVelocity, kVelocity) = R;
  turn.block<2, 2>(kGravity, kGravity) =
      tangent_basis(gravity).transpose() * R * tangent_basis(state.gravity);
  initial.covariance = (turn * initial.covariance * turn.transpose()).eval();
  initial.covariance.diagonal().segment<3>(kPosition).array() +=
      kPositionDeviation * kPositionDeviation;
  initial.covariance.diagonal().segment<3>(kRotation).array() +=
      kRotationDeviation * kRotationDeviation;
  state.T_world_body = T_map_body;
  state.velocity = (R * state.velocity).eval();
  state.gravity = gravity;
}

ImuInitializer::ImuInitializer(const InitializerOptions& options) : options_(options) {
  options.validate();
}

void ImuInitializer::add(const ImuSample& sample) {
  if (window_.empty()) {
    first_time_ = sample.time;
  } else {
    const double dt = sample.time - window_.back().time;
    R_first_body_ *= so3_exp(dt * (0.5 * (sample.gyro + window_.back().gyro)));
    force_sum_ += dt * (R_first_body_ * sample.accel);
  }
  window_.push_back(sample);
  const double oldest = sample.time - options_.still_duration;
  const auto keep = std::find_if(window_.begin(), window_.end(), [oldest](const ImuSample& s) {
    return s.time >= oldest - 1e-9;
  });
  window_.erase(window_.begin(), keep);
  state_ = still_state();
}

std::optional<InitialState> ImuInitializer::state() const { return state_; }

std::optional<InitialState> ImuInitializer::still_state() {
  constexpr std::size_t kMinSamples = 10;
  constexpr double kGravityTolerance = 0.25;
  constexpr double kMaxDelay = 3.0;  // until there are enough readings, in still_duration
  const double span = window_.back().time - window_.front().time;
  const double waited = window_.back().time - first_time_;
  const bool has_enough = window_.size() >= kMinSamples && span >= 0.9 * options_.still_duration;
  const Stillness stillness = judge_stillness(window_, options_);
  const double force = stillness.mean_accel.norm();
  const bool is_on_earth =
      std::abs(force - options_.gravity) <= kGravityTolerance * options_.gravity;
  const bool moves = window_.size() >= kMinSamples && !stillness.still;
  is_hopeless_ = options_.moving_start_after >= 0.0 &&
                 ((moves && waited >= options_.moving_start_after) ||
                  (has_enough && !is_on_earth) || waited > kMaxDelay * options_.still_duration);
  std::ostringstream why;
  if (moves) {
    why << "the sensor moves: keep it still for " << options_.still_duration << " s (rate "
        << stillness.mean_gyro.norm() << " +- " << stillness.gyro_deviation
        << " rad/s, specific force +- " << stillness.accel_deviation << " m/s^2)";
  } else if (!has_enough) {
    why << "IMU initialisation needs " << options_.still_duration << " s of data";
  } else if (!is_on_earth) {
    why << "the accelerometer reads " << force << " m/s^2 at rest, not " << options_.gravity;
  }
  why_not_ = why.str();
  return why_not_.empty() ? std::optional<InitialState>(state_at_rest(stillness)) : std::nullopt;
}

InitialState ImuInitializer::state_at_rest(const Stillness& stillness) const {
  const Eigen::Vector3d& force = stillness.mean_accel;
  InitialState initial;
  initial.state.time = window_.back().time;
  initial.state.T_world_body.linear() = levelled(force);
  initial.state.gyro_bias = stillness.mean_gyro;
  initial.state.accel_bias = force * (1.0 - options_.gravity / force.norm());
  initial.state.gravity = {0.0, 0.0, -options_.gravity};
  initial.covariance = covariance_of(kStill);
  tie_bias_to_gravity(initial);
  initial.rest_force = force;
  return initial;
}

Eigen::Matrix3d ImuInitializer::level() const {
  return force_sum_.isZero() ? Eigen::Matrix3d(R_first_body_)
                             : Eigen::Matrix3d(levelled(force_sum_) * R_first_body_);
}

InitialState moving_state(
    const StampedPose& T_world_body,
    const Eigen::Vector3d& velocity,
    const Eigen::Vector3d& gravity) {
  InitialState initial;
  initial.state.time = T_world_body.time;
  initial.state.T_world_body = T_world_body.pose;
  initial.state.velocity = velocity;
  initial.state.gravity = gravity;
  initial.covariance = covariance_of(kMoving);
  return initial;
}

void InitializerOptions::validate() const {
  require(
      still_duration >= 0.2 && still_duration <= 10.0,
      "still_duration",
      still_duration,
      "0.2 to 10 [s]");
  require(max_still_gyro > 0.0, "max_still_gyro", max_still_gyro, "positive [rad/s]");
  require(max_still_accel > 0.0, "max_still_accel", max_still_accel, "positive [m/s^2]");
  require(max_still_rate > 0.0, "max_still_rate", max_still_rate, "positive [rad/s]");
  require(
      moving_start_after < 0.0 || moving_start_after >= 0.2,
      "moving_start_after",
      moving_start_after,
      "negative (never) or at least 0.2 [s]");
  require(gravity > 1.0 && gravity < 30.0, "gravity", gravity, "1 to 30 [m/s^2]");
}

}  // namespace nvm::lio
