// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_outliers.hpp"

#include <algorithm>

namespace nvm::lio {

namespace {

constexpr std::size_t kEnough = 10;        // good readings that tell what is off
constexpr int kRegular = 10;               // changes on end of an axis that always changes
constexpr double kMaxLeapInterval = 0.05;  // [s]: beyond it a motion may leap
constexpr double kLongestStill = 0.05;     // [s]

}  // namespace

bool ImuOutliers::Triad::leaps(const Eigen::Vector3d& value, double least) const {
  constexpr double kFactor = 8.0;
  return (value - last).norm() > std::max(least, kFactor * largest.norm());
}

// Noise hides zero from a sensor that works.
bool ImuOutliers::Triad::falls_to_zero(const Eigen::Vector3d& value) const {
  constexpr double kFactor = 3.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (value[axis] == 0.0 && changes[axis] >= kRegular &&
        std::abs(last[axis]) > kFactor * largest[axis]) {
      return true;
    }
  }
  return false;
}

bool ImuOutliers::Triad::is_stuck(const Eigen::Vector3d& value, double time) const {
  return value == latest && did_change && time - still_since > kLongestStill;
}

void ImuOutliers::Triad::note(const Eigen::Vector3d& value, double time) {
  if (value != latest) {
    did_change = (changes >= kRegular).all();
    still_since = time;
  }
  latest = value;
}

void ImuOutliers::Triad::add_good(const Eigen::Vector3d& value) {
  constexpr double kMemory = 0.9;
  const Eigen::Vector3d step = (value - last).cwiseAbs();
  largest = step.cwiseMax(kMemory * largest);
  changes = (step.array() > 0.0).select(changes + 1, 0);
  last = value;
}

bool ImuOutliers::is_dead(const ImuSample& reading) const {
  constexpr double kTurning = 0.1;  // [rad/s]
  const bool is_stuck =
      gyro_.is_stuck(reading.gyro, reading.time) || accel_.is_stuck(reading.accel, reading.time);
  return gyro_.falls_to_zero(reading.gyro) || accel_.falls_to_zero(reading.accel) ||
         (is_stuck && reading.gyro.norm() > kTurning);
}

bool ImuOutliers::is_off(const ImuSample& reading) const {
  // Knocks of 3 g, or of 4 g within 10 ms, leap by less, and so does what they turn.
  constexpr double kMinGyroLeap = 3.0;        // [rad/s]
  constexpr double kMaxGyroChange = 300.0;    // [rad/s^2]
  constexpr double kMinAccelLeap = 30.0;      // [m/s^2]
  constexpr double kMaxAccelChange = 4500.0;  // [m/s^3]
  // What a hand may have changed since the last good reading.
  constexpr double kGyroChange = 15.0;  // [rad/s^2]
  constexpr double kLongest = 0.5;      // [s]
  const double interval = reading.time - latest_time_;
  if (good_ < kEnough || interval > kMaxLeapInterval) {
    return false;
  }
  const double since = std::min(reading.time - last_time_ - interval, kLongest);
  const double gyro_leap = std::max(kMinGyroLeap, kMaxGyroChange * interval) + kGyroChange * since;
  return gyro_.leaps(reading.gyro, gyro_leap) ||
         accel_.leaps(reading.accel, std::max(kMinAccelLeap, kMaxAccelChange * interval)) ||
         is_dead(reading);
}

bool ImuOutliers::is_nonsense(const ImuSample& reading) const {
  constexpr double kMaxGyro = 20.0;   // off the last good one [rad/s]
  constexpr double kMaxAccel = 45.0;  // [m/s^2]: 4.5 m/s in a tenth of a second
  return is_dead(reading) || (reading.gyro - gyro_.last).norm() > kMaxGyro ||
         (reading.accel - accel_.last).norm() > kMaxAccel;
}

void ImuOutliers::note(const ImuSample& reading) {
  gyro_.note(reading.gyro, reading.time);
  accel_.note(reading.accel, reading.time);
  latest_time_ = reading.time;
}

void ImuOutliers::add_good(const ImuSample& reading) {
  gyro_.add_good(reading.gyro);
  accel_.add_good(reading.accel);
  last_time_ = reading.time;
  ++good_;
}

}  // namespace nvm::lio
