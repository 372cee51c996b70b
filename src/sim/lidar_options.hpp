// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>

namespace nvm::sim {

/// How a LiDAR is mounted and how it errs. Probabilities are per shot.
struct LidarOptions {
  double scan_rate = 10.0;               ///< [Hz]
  double min_range = 0.1;                ///< [m]
  double max_range = 100.0;              ///< [m]
  double range_noise = 0.01;             ///< standard deviation [m]
  double range_noise_per_metre = 0.0;    ///< more of it at long range
  double range_noise_per_tangent = 0.0;  ///< more at slanting incidence: times tan(angle) [m]
  double range_bias_per_tangent = 0.0;   ///< longer at slanting incidence: times tan(angle) [m]
  double range_bias_dark = 0.0;          ///< longer on dark surfaces: times 1 - reflectivity [m]
  double range_quantum = 0.0;            ///< ranges are multiples of it [m]; 0: any
  double blooming = 0.0;        ///< that a shot close to a bright surface returns its range
  double mixed_pixels = 0.0;    ///< that a beam across an edge returns a range in between
  double outliers = 0.0;        ///< that the range is any up to the true one
  double dropouts = 0.0;        ///< that nothing returns
  double divergence_deg = 0.2;  ///< full width of the beam
  Eigen::Vector3d p_imu_lidar = Eigen::Vector3d::Zero();  ///< the LiDAR in the IMU frame [m]
  /// Roll, pitch and yaw of the LiDAR in the IMU frame.
  Eigen::Vector3d rotation_imu_lidar_deg = Eigen::Vector3d::Zero();
};

}  // namespace nvm::sim
