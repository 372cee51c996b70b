// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <vector>

#include "common/sensor_data.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::lio {

/// What the IMU has read, and which poses the scans have told, in the last seconds.
class MotionHistory {
 public:
  /// From one pose to the next.
  struct Turn {
    double begin, end;         ///< [s]
    Eigen::Vector3d by_scans;  ///< rotation vector [rad], body frame
  };

  /// In order of time; others are left out.
  void add(const ImuSample& reading);
  void add(const StampedPose& T_map_body);
  void clear() { *this = MotionHistory(); }
  /// Moves the readings by a time [s].
  void move_readings(double by);
  /// Turns the readings into other axes.
  void turn_readings(const Eigen::Matrix3d& rotation);

  /// Time from the first pose to the last [s].
  double duration() const;
  /// The poses of the last `duration` [s].
  Trajectory poses(double duration) const;
  /// The readings up to `time` [s], oldest first, those before `begin` left out.
  std::vector<ImuSample> readings(double begin, double end) const;

  /// Between all poses close enough to each other that a turn cannot have gone there and back.
  std::vector<Turn> turns() const;
  /// Integral of the gyroscope's readings up to `time` [s]; only differences mean something.
  std::optional<Eigen::Vector3d> turned_at(double time) const;

 private:
  struct Reading {
    ImuSample sample;
    Eigen::Vector3d turned;
  };

  std::deque<Reading> readings_;
  std::deque<StampedPose> poses_;
};

}  // namespace nvm::lio
