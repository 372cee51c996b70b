// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "common/sensor_data.hpp"

namespace nvm::lio {

/// Tells readings that no motion explains from the ones before them: those of a sensor that leap
/// away at once, turn to exactly zero, or stand still to the last digit while the body turns.
/// Motion, a shock as well, comes in steps that grow.
class ImuOutliers {
 public:
  /// Whether `reading`, the next in order of time, is off the good ones.
  bool is_off(const ImuSample& reading) const;
  /// Whether such a reading stays wrong however long there are others like it.
  bool is_nonsense(const ImuSample& reading) const;

  /// Takes a reading in order of time, also one that is off.
  void note(const ImuSample& reading);
  /// Takes a good reading that has been noted.
  void add_good(const ImuSample& reading);

 private:
  /// A gyroscope or an accelerometer.
  struct Triad {
    Eigen::Vector3d last = Eigen::Vector3d::Zero();     ///< of the good readings
    Eigen::Vector3d latest = Eigen::Vector3d::Zero();   ///< of all readings
    Eigen::Vector3d largest = Eigen::Vector3d::Zero();  ///< step of late, each axis
    Eigen::Array3i changes = Eigen::Array3i::Zero();    ///< on end, each axis
    bool did_change = false;   ///< with every reading, before it stood still
    double still_since = 0.0;  ///< stands as it is [s]

    bool leaps(const Eigen::Vector3d& value, double least) const;
    bool falls_to_zero(const Eigen::Vector3d& value) const;
    bool is_stuck(const Eigen::Vector3d& value, double time) const;
    void note(const Eigen::Vector3d& value, double time);
    void add_good(const Eigen::Vector3d& value);
  };

  bool is_dead(const ImuSample& reading) const;

  Triad gyro_, accel_;
  std::size_t good_ = 0;
  double last_time_ = 0.0, latest_time_ = 0.0;  ///< of good readings, of all [s]
};

}  // namespace nvm::lio
