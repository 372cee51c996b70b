// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/motion.hpp"

#include <cmath>

#include "sim/angles.hpp"
#include "sim/jet.hpp"
#include "sim/random.hpp"

namespace nvm::sim {
namespace {

constexpr double kPathSpacing = 0.4;     ///< of knots [s]: rounds corners within about 0.5 m
constexpr double kHeadingSpacing = 0.8;  ///< of knots [s]: a right angle takes about 1.5 s

/// A wave of a typical walker: the seed varies its amplitude, and its phase is free.
struct TypicalWave {
  std::size_t degree;  ///< forward, left, up, roll, pitch, yaw
  double amplitude;    ///< [m] or [rad]
  double frequency;    ///< in steps of gait, or [Hz] for the hand
};

constexpr std::array<TypicalWave, 6> kGait{{
    {0, 0.008, 1.0},
    {1, 0.015, 0.5},
    {2, 0.018, 1.0},
    {3, rad(1.2), 0.5},
    {4, rad(1.2), 1.0},
    {5, rad(1.8), 0.5},
}};
constexpr std::array<TypicalWave, 6> kHand{{
    {3, rad(1.5), 0.23},
    {3, rad(1.0), 0.41},
    {4, rad(2.0), 0.17},
    {4, rad(1.0), 0.37},
    {5, rad(4.0), 0.13},
    {5, rad(2.0), 0.31},
}};

}  // namespace

Motion::Motion(
    const Route& route, const MotionOptions& options, std::uint64_t seed, double duration)
    : walk_(route, options, seed, decltype(heading_)::kReach * kHeadingSpacing),
      duration_(duration > 0.0 ? duration : walk_.duration()),
      height_(options.height),
      path_(
          duration_,
          kPathSpacing,
          [&](double t) {
            const Eigen::Vector3d p = walk_.position(t);
            return std::array<double, 4>{p.x(), p.y(), p.z(), walk_.activity(t)};
          }),
      heading_(duration_, kHeadingSpacing, [&](double t) {
        return std::array<double, 1>{walk_.heading(t)};
      }) {
  const double direction = Random(seed, Stream::kGait, 1).uniform(0.0, 2.0 * M_PI);
  roll_ = rad(options.tilt_deg) * std::cos(direction);
  pitch_ = rad(options.tilt_deg) * std::sin(direction);
  add_waves(options, seed);
}

void Motion::add_waves(const MotionOptions& options, std::uint64_t seed) {
  Random random(seed, Stream::kGait, 2);
  const auto add = [&](const TypicalWave& typical, double scale, double frequency_scale) {
    waves_.push_back(
        {typical.degree,
         typical.amplitude * scale * random.uniform(0.8, 1.2),
         2.0 * M_PI * typical.frequency * frequency_scale,
         random.uniform(0.0, 2.0 * M_PI)});
  };
  const double steps_per_second = random.uniform(1.7, 2.0);
  for (const TypicalWave& wave : kGait) {
    add(wave, options.gait, steps_per_second);
  }
  for (const TypicalWave& wave : kHand) {
    add(wave, options.wander, random.uniform(0.9, 1.1));
  }
}

/// x, y, z [m], roll, pitch, yaw [rad].
template <class Scalar>
auto Motion::coordinates(const Scalar& t) const -> std::array<Scalar, kDegreesOfFreedom> {
  using std::cos;
  using std::sin;
  const auto [x, y, floor, activity] = path_.at(t);
  const Scalar heading = heading_.at(t)[0];
  std::array<Scalar, kDegreesOfFreedom> offsets{};
  for (const Wave& wave : waves_) {
    offsets[wave.degree] = offsets[wave.degree] + wave.amplitude * sin(wave.rate * t + wave.phase);
  }
  for (Scalar& offset : offsets) {
    offset = offset * activity;
  }
  const auto& [forward, left, up, roll, pitch, yaw] = offsets;
  const Scalar c = cos(heading);
  const Scalar s = sin(heading);
  return {
      x + c * forward - s * left,
      y + s * forward + c * left,
      floor + height_ + up,
      roll_ + roll,
      pitch_ + pitch,
      heading + yaw};
}

Pose Motion::pose(double time) const {
  const auto [x, y, z, roll, pitch, yaw] = coordinates(time);
  Pose pose = Pose::Identity();
  pose.linear() = euler_rotation(roll, pitch, yaw);
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

Kinematics Motion::kinematics(double time) const {
  const auto [x, y, z, roll, pitch, yaw] = coordinates(time_jet(time));
  Kinematics result;
  result.T_world_imu.linear() = euler_rotation(roll.value, pitch.value, yaw.value);
  result.T_world_imu.translation() = Eigen::Vector3d(x.value, y.value, z.value);
  result.velocity = Eigen::Vector3d(x.first, y.first, z.first);
  result.acceleration = Eigen::Vector3d(x.second, y.second, z.second);
  const double cr = std::cos(roll.value), sr = std::sin(roll.value);
  const double cp = std::cos(pitch.value), sp = std::sin(pitch.value);
  result.angular_velocity = Eigen::Vector3d(
      roll.first - sp * yaw.first,
      cr * pitch.first + sr * cp * yaw.first,
      -sr * pitch.first + cr * cp * yaw.first);
  return result;
}

}  // namespace nvm::sim
