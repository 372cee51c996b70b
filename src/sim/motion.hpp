// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "nvm/geometry/pose.hpp"
#include "sim/motion_options.hpp"
#include "sim/scene.hpp"
#include "sim/uniform_spline.hpp"
#include "sim/walk.hpp"

namespace nvm::sim {

/// A pose and its exact derivatives.
struct Kinematics {
  Pose T_world_imu = Pose::Identity();
  Eigen::Vector3d velocity;          ///< of the IMU, world frame [m/s]
  Eigen::Vector3d acceleration;      ///< of the IMU, world frame [m/s^2]
  Eigen::Vector3d angular_velocity;  ///< in the IMU frame [rad/s]
};

/// The motion of a hand-held sensor: a smoothed walk, with the sway and bob of steps and slow turns
/// of the hand on top. Four times continuously differentiable; every derivative is analytic.
class Motion {
 public:
  /// Follows `route` for `duration` [s]; 0: to its end. Throws std::invalid_argument for options
  /// outside their ranges.
  Motion(const Route& route, const MotionOptions& options, std::uint64_t seed, double duration);

  double duration() const { return duration_; }

  /// True pose T_world_imu at `time` in [0, duration].
  Pose pose(double time) const;
  Kinematics kinematics(double time) const;

 private:
  static constexpr std::size_t kDegreesOfFreedom = 6;

  /// amplitude * sin(2 pi frequency t + phase) on one of forward, left, up [m], roll, pitch, yaw.
  struct Wave {
    std::size_t degree = 0;
    double amplitude = 0.0;
    double rate = 0.0;  ///< [rad/s]
    double phase = 0.0;
  };

  template <class Scalar>
  std::array<Scalar, kDegreesOfFreedom> coordinates(const Scalar& t) const;

  void add_waves(const MotionOptions& options, std::uint64_t seed);

  Walk walk_;
  double duration_;
  double height_;
  double roll_ = 0.0;      ///< mean [rad]
  double pitch_ = 0.0;     ///< mean [rad]
  UniformSpline<4> path_;  ///< x, y, floor and activity
  UniformSpline<1> heading_;
  std::vector<Wave> waves_;
};

}  // namespace nvm::sim
