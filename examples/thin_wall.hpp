// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "nvm/geometry/pose.hpp"

/// The scene of the examples: a wall of 5 cm across the y axis, on a floor, seen from both sides.
namespace thin_wall {

inline constexpr double kFrontY = 0.1;  // where its faces are [m]
inline constexpr double kBackY = 0.15;
inline constexpr double kRangeNoise = 0.005;  // standard deviation [m]

/// A return of the sensor: any struct with x, y and z will do [m].
struct Return {
  float x, y, z;
};

/// What a sensor at `origin` sees of the wall's near face and of the floor, in the axes of the map
/// with the sensor as the origin.
inline std::vector<Return> scan_from(const Eigen::Vector3d& origin) {
  static std::mt19937 random;  // no two scans have the same noise
  std::normal_distribution<double> noise(0.0, kRangeNoise);
  const bool in_front = origin.y() < kFrontY;
  const double face_y = in_front ? kFrontY : kBackY;
  std::vector<Return> scan;
  const auto see = [&](const Eigen::Vector3d& target) {
    const Eigen::Vector3d ray = target - origin;
    const Eigen::Vector3f hit = (ray + noise(random) * ray.normalized()).cast<float>();
    scan.push_back({hit.x(), hit.y(), hit.z()});
  };
  for (double x = -2.0; x <= 2.0; x += 0.05) {
    for (double step = 0.05; step <= 2.0; step += 0.05) {
      see({x, face_y, step});                             // the wall, upwards
      see({x, face_y + (in_front ? -step : step), 0.0});  // the floor, away from the wall
    }
  }
  return scan;
}

/// The pose of a sensor at `origin` with the axes of the map.
inline nvm::Pose pose_at(const Eigen::Vector3d& origin) {
  nvm::Pose T_map_scan = nvm::Pose::Identity();
  T_map_scan.translation() = origin;
  return T_map_scan;
}

}  // namespace thin_wall
