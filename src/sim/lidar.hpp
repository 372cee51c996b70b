// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "common/sensor_data.hpp"
#include "sim/lidar_options.hpp"
#include "sim/motion.hpp"
#include "sim/random.hpp"
#include "sim/ray_caster.hpp"
#include "sim/sensor_model.hpp"

namespace nvm::sim {

/// Where a return really comes from.
enum class Origin : std::uint8_t {
  kSurface,
  kPerson,
  kMirror,  ///< a surface seen in a mirror
  kMixedPixel,
  kBlooming,  ///< the range of a bright surface beside the beam
  kOutlier
};

struct ReturnTruth {
  Origin origin = Origin::kSurface;
  SurfaceId surface;  ///< that the beam's centre hits; of a person: none
};

/// A scan, and the truth about each of its points.
struct SimulatedScan {
  Scan scan;
  std::vector<ReturnTruth> truth;
};

/// What a LiDAR moves through.
struct World {
  const Scene& scene;
  const RayCaster& rays;  ///< into that scene
  const Motion& motion;
};

/// A LiDAR that is carried along a motion through a scene. Safe to use from many threads at once.
class Lidar {
 public:
  /// The references in `world` and the sensor must outlive the LiDAR.
  Lidar(
      const SensorModel& sensor,
      const LidarOptions& options,
      const World& world,
      std::uint64_t seed);

  /// Scan `index`, from time index / scan_rate; each shot is cast from the true pose at its time.
  SimulatedScan scan(std::size_t index) const;

  /// T_imu_lidar, the true pose of the LiDAR in the IMU frame.
  const Pose& extrinsic() const { return T_imu_lidar_; }

 private:
  struct Return {
    double range = 0.0;
    double intensity = 0.0;
    ReturnTruth truth;
  };

  /// A beam's centre on its way, in the world frame.
  struct Shot {
    std::uint64_t index = 0;    ///< within the sequence
    double time = 0.0;          ///< [s]
    Eigen::Vector3d origin;     ///< [m]
    Eigen::Vector3d direction;  ///< unit
  };

  /// What throws the light back.
  struct Echo {
    double range = 0.0;  ///< as long as the light's way [m]
    Eigen::Vector3d normal;
    double cosine = 0.0;  ///< of the incidence
    double reflectivity = 0.0;
    double mirror = 0.0;
    ReturnTruth truth;
  };

  std::optional<Return> shoot(const Shot& shot) const;
  std::optional<Echo> hear(const Shot& shot, double pass, Random& luck) const;
  std::optional<Echo> first_surface(const Shot& ray, double pass) const;
  double measured_range(const Echo& echo, Random& random) const;
  std::optional<double> mixed_range(const Echo& echo, const Shot& shot, Random& random) const;
  std::optional<double> bright_range(const Shot& shot, Random& random) const;

  /// A shot `offset` [rad] beside that one, on a side drawn by chance.
  static Shot beside(const Shot& shot, double offset, Random& random);

  const SensorModel& sensor_;
  LidarOptions options_;
  World world_;
  std::uint64_t seed_;
  Pose T_imu_lidar_;
};

}  // namespace nvm::sim
