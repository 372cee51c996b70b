// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lio/sensor_data.hpp"
#include "sim/motion.hpp"
#include "sim/random.hpp"
#include "sim/ray_caster.hpp"
#include "sim/sensor_model.hpp"

namespace nvm::sim {

/// How a LiDAR errs. Probabilities are per shot.
struct LidarOptions {
  double scan_rate = 10.0;               ///< [Hz]
  double range_noise = 0.01;             ///< standard deviation [m]
  double range_noise_per_metre = 0.0;    ///< more of it at long range
  double range_noise_per_tangent = 0.0;  ///< more of it at slanting incidence: times tan(angle) [m]
  double mixed_pixels = 0.0;  ///< that a beam which straddles an edge returns a range in between
  double outliers = 0.0;      ///< that the range is any up to the true one
  double dropouts = 0.0;      ///< that nothing returns
  double min_range = 0.0;     ///< [m]; 0: the sensor's
  double max_range = 0.0;     ///< [m]; 0: the sensor's
};

/// Where a return really comes from.
enum class Origin : std::uint8_t { kSurface, kMixedPixel, kOutlier };

struct ReturnTruth {
  Origin origin = Origin::kSurface;
  SurfaceId surface;  ///< that the beam's centre hits
};

/// A scan, and the truth about each of its points.
struct SimulatedScan {
  lio::Scan scan;
  std::vector<ReturnTruth> truth;
};

/// A LiDAR that is carried along a motion through a scene. Safe to use from many threads at once.
class Lidar {
 public:
  /// References must outlive the LiDAR.
  Lidar(
      const SensorModel& sensor,
      const LidarOptions& options,
      const RayCaster& rays,
      const Motion& motion,
      std::uint64_t seed);

  /// Scan `index`, from time index / scan_rate; each shot is cast from the true pose at its time.
  SimulatedScan scan(std::size_t index) const;

  /// True pose of the LiDAR in the IMU frame.
  const Pose& T_imu_lidar() const { return T_imu_lidar_; }

 private:
  struct Return {
    double range = 0.0;
    double intensity = 0.0;
    ReturnTruth truth;
  };

  std::optional<Return> shoot(
      const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, Random& random) const;
  double measured_range(const RayHit& hit, double cosine, Random& random) const;
  std::optional<double> mixed_range(
      const RayHit& hit,
      const Eigen::Vector3d& origin,
      const Eigen::Vector3d& direction,
      Random& random) const;

  const SensorModel& sensor_;
  LidarOptions options_;
  const RayCaster& rays_;
  const Motion& motion_;
  std::uint64_t seed_;
  Pose T_imu_lidar_;
};

}  // namespace nvm::sim
