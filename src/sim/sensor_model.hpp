// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/lidar_options.hpp"

namespace nvm::sim {

/// One shot of a LiDAR.
struct Firing {
  double dt = 0.0;            ///< after the begin of the scan [s]
  Eigen::Vector3d direction;  ///< unit, LiDAR frame (x forward, z up)
  std::uint16_t ring = 0;
};

/// How a LiDAR moves its beams.
enum class ScanPattern {
  kSpinning,  ///< a stack of lasers turns once per scan
  kNodding,   ///< lines that turn fast and nod faster, never the same way twice (Mid-360)
  kRosette,   ///< lines that two rotating prisms steer through a forward cone (Avia)
};

/// The fixed properties of a LiDAR.
struct SensorModel {
  std::string name;
  std::string description;
  ScanPattern pattern = ScanPattern::kSpinning;
  std::vector<double> elevations_deg;  ///< spinning: of each laser, in order of firing
  double laser_delay = 0.0;            ///< spinning: between the lasers of one column [s]
  int lines = 0;                       ///< others: how many; they fire in turn
  double points_per_second = 0.0;
  LidarOptions defaults;  ///< its ranges, its beam and its place beside the IMU

  /// Shots in one scan of 1 / `scan_rate` seconds.
  std::size_t shots_per_scan(double scan_rate) const;

  /// Shot `shot` of scan `scan`; dt ascends with the shot.
  Firing firing(std::size_t scan, std::size_t shot, double scan_rate) const;
};

/// The sensors that nvm knows.
const std::vector<SensorModel>& sensor_models();

/// The one called `name`. Throws std::invalid_argument with the list of names when there is none.
const SensorModel& find_sensor(const std::string& name);

}  // namespace nvm::sim
