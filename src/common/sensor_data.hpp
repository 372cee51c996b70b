// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace nvm {

/// One LiDAR return, raw: in the LiDAR frame at its own time.
struct TimedPoint {
  float x = 0.0F;  ///< [m]
  float y = 0.0F;
  float z = 0.0F;
  float intensity = 0.0F;
  float dt = 0.0F;  ///< after Scan::t_begin [s]
  std::uint16_t ring = 0;

  float sq_range() const { return x * x + y * y + z * z; }  ///< [m^2]
};

/// The returns of one sweep, in ascending order of `dt`. A sensor without point times has dt = 0
/// throughout and t_begin = t_end.
struct Scan {
  double t_begin = 0.0;  ///< [s]
  double t_end = 0.0;    ///< [s]
  std::vector<TimedPoint> points;
};

/// One IMU reading in the IMU (body) frame.
struct ImuSample {
  double time = 0.0;      ///< [s]
  Eigen::Vector3d gyro;   ///< angular velocity [rad/s]
  Eigen::Vector3d accel;  ///< specific force [m/s^2]: +9.81 upwards at rest
};

}  // namespace nvm
