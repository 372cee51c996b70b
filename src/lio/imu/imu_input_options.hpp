// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

/// What to make of the IMU's numbers.
struct ImuInputOptions {
  /// Factors that make rad/s and m/s^2 of what the IMU sends: 0.0174533 for degrees per second,
  /// 9.80665 for g, -1 where the sign is wrong. 0: found from the data.
  double gyro_scale = 0.0;
  double accel_scale = 0.0;
  /// Added to the IMU's times [s]: negative where its clock is late.
  double time_offset = 0.0;
  /// Whether what is left of it is learned from the turns of scans and gyroscope.
  bool learns_time_offset = true;
  /// Whether a rotation of the extrinsic that is off by degrees is learned from them too.
  bool learns_rotation = true;

  void validate() const;
};

/// What a run takes for granted of its IMU.
struct ImuSetup {
  ImuInputOptions input;
  Pose T_imu_lidar = Pose::Identity();
};

}  // namespace nvm::lio
