// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"
#include "lio/state/nav_state.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::lio {

/// How the first state is found from the IMU alone.
struct InitializerOptions {
  /// Time that the sensor must keep still [s], 0.2 to 10.
  double still_duration = 1.0;
  /// The sensor counts as still when the standard deviation of the angular rate [rad/s] and of the
  /// specific force [m/s^2], without the IMU's white noise, stay below these, and its mean rate
  /// below max_still_rate.
  double max_still_gyro = 0.03;
  double max_still_accel = 0.3;
  double max_still_rate = 0.05;  ///< [rad/s]
  /// When the sensor moves, after this long the scans begin alone and the IMU joins them later [s],
  /// at least 0.2; negative: never, wait for a still moment for ever.
  double moving_start_after = 0.3;
  /// Magnitude of gravity [m/s^2].
  double gravity = 9.81;

  void validate() const;
};

/// How still the sensor was during some readings, by InitializerOptions' limits.
struct Stillness {
  bool still = false;
  Eigen::Vector3d mean_gyro = Eigen::Vector3d::Zero();   ///< [rad/s]
  Eigen::Vector3d mean_accel = Eigen::Vector3d::Zero();  ///< [m/s^2]
  double gyro_deviation = 0.0;   ///< [rad/s], of the vector, without white noise
  double accel_deviation = 0.0;  ///< [m/s^2], of the vector, without white noise
};

/// `readings` must not be empty.
Stillness judge_stillness(
    const std::vector<ImuSample>& readings, const InitializerOptions& options);

/// The first state and how sure it is.
struct InitialState {
  NavState state;
  NavCovariance covariance;
  /// That the accelerometer felt at rest [m/s^2, body frame]; zero in motion.
  Eigen::Vector3d rest_force = Eigen::Vector3d::Zero();
};

/// Moves `initial` to a map that others have begun, in which the body is at about T_map_body:
/// gravity, velocity and what is known of them turn along, so that the map need not be level.
void move_to(const Pose& T_map_body, InitialState& initial);

/// The first state at a pose that the scans tell, `velocity` [m/s] and `gravity` [m/s^2] in the
/// world frame.
InitialState moving_state(
    const StampedPose& T_world_body,
    const Eigen::Vector3d& velocity,
    const Eigen::Vector3d& gravity);

/// Finds gravity and the gyro bias from the first IMU readings. The world frame has its origin in
/// the first body frame, z up, and the body's initial heading as its x axis.
class ImuInitializer {
 public:
  explicit ImuInitializer(const InitializerOptions& options);

  /// Takes readings in order of time.
  void add(const ImuSample& sample);

  /// The state at the last reading, once it can be told; `why_not` says what is missing otherwise.
  std::optional<InitialState> state() const;
  const std::string& why_not() const { return why_not_; }

  /// True when no state is to be had soon: the sensor moves, or the readings are not those of one
  /// at rest on earth.
  bool is_hopeless() const { return is_hopeless_; }
  /// R_world_body with z up, by the mean specific force so far in a frame that does not turn.
  Eigen::Matrix3d level() const;

 private:
  std::optional<InitialState> still_state();
  InitialState state_at_rest(const Stillness& stillness) const;

  InitializerOptions options_;
  std::vector<ImuSample> window_;                               ///< the last still_duration seconds
  Eigen::Matrix3d R_first_body_ = Eigen::Matrix3d::Identity();  ///< by the gyro alone
  Eigen::Vector3d force_sum_ = Eigen::Vector3d::Zero();  ///< specific force x time, first frame
  std::optional<InitialState> state_;
  double first_time_ = 0.0;
  bool is_hopeless_ = false;
  std::string why_not_ = "no IMU data yet";
};

}  // namespace nvm::lio
