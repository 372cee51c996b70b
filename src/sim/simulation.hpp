// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "sim/imu.hpp"
#include "sim/lidar.hpp"
#include "sim/motion_options.hpp"
#include "sim/scene.hpp"

namespace nvm::config {
class Schema;
}

namespace nvm::sim {

/// What to simulate in a scene. Start from `options_for`.
struct SimulationOptions {
  std::string sensor;
  std::uint64_t seed = 1;  ///< of all noise, and of the details of the walk
  double duration = 0.0;   ///< [s]; 0: to the end of the route
  MotionOptions motion;
  LidarOptions lidar;
  ImuOptions imu;
};

/// The defaults for the sensor called `sensor`. Throws std::invalid_argument for an unknown one.
SimulationOptions options_for(const std::string& sensor);

/// Binds the keys "motion.*", "lidar.*" and "imu.*" to `options`.
void bind(config::Schema& schema, SimulationOptions& options);

/// What a simulation has written.
struct SimulationSummary {
  std::size_t scans = 0;
  std::size_t points = 0;
  std::size_t imu_samples = 0;
  double duration = 0.0;     ///< [s]
  double path_length = 0.0;  ///< [m]
};

/// Simulates `scene` and writes a sequence folder, with its true trajectory and its scene. The same
/// scene, options and seed give the same bytes, for any number of threads.
///
/// Throws std::invalid_argument for an unknown sensor or a scene without a route, and
/// std::runtime_error when the route is blocked, `folder` exists or cannot be written; nothing is
/// left of the folder then. The same holds for what `check` throws, which is called every few
/// scans.
SimulationSummary simulate(
    const Scene& scene,
    const SimulationOptions& options,
    const std::string& folder,
    const std::function<void()>& check = [] {});

}  // namespace nvm::sim
