// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>

#include "adapters/host_shapes/host_odometry.hpp"
#include "eval/walls/oriented_cloud.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::test {

/// What a host-shaped odometry makes of a sequence.
struct HostOutput {
  Trajectory trajectory;      ///< T_map_imu at the ends of scans
  eval::OrientedCloud cloud;  ///< every tenth registered point; normals: directions to the sensor
  std::size_t map_points = 0;
  double cpu_ms = 0.0;  ///< per scan, reading left out
};

/// Runs the nvm sequence in `folder`. Throws std::runtime_error when it is malformed.
HostOutput drive_host(const std::string& folder, const HostShape& shape, HostMapKind kind);

/// What came of a host-shaped odometry on a sequence with known truth.
struct HostRun {
  double ate_mm = 0.0;    ///< RMSE of positions after SE(3) alignment
  double wall_mm = 0.0;   ///< mean absolute error of the thickness of the walls that were seen
  std::size_t walls = 0;  ///< that were measured
  std::size_t map_points = 0;
  double cpu_ms = 0.0;  ///< per scan, reading left out
};

/// drive_host, compared with the truth in `folder`. A point of the registered scans counts to the
/// side of a wall that it was seen from. Throws std::runtime_error when the sequence is malformed,
/// or the trajectory cannot be compared with its truth.
HostRun run_host(const std::string& folder, const HostShape& shape, HostMapKind kind);

/// In one line, for people.
std::string describe(const HostRun& run);

}  // namespace nvm::test
