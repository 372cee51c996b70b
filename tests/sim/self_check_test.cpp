// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/self_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sim/angles.hpp"
#include "sim/lidar.hpp"
#include "sim/scene_file.hpp"
#include "sim/simulation.hpp"

namespace nvm::sim {
namespace {

class SelfCheck : public ::testing::TestWithParam<const char*> {
 protected:
  SelfCheck()
      : scene_(load_scene("rooms")),
        rays_(scene_),
        motion_(scene_.route, {}, 11, 0.0),
        options_(options_for(GetParam())) {}

  Lidar lidar() const {
    return Lidar(find_sensor(GetParam()), options_.lidar, {scene_, rays_, motion_}, 11);
  }

  /// Over scans spread along the walk.
  test::RangeResiduals residuals(const Pose& T_imu_lidar, double clock_shift = 0.0) const {
    const Lidar sensor = lidar();
    test::RangeResiduals result;
    for (std::size_t i = 0; i < 10; ++i) {
      result.add(sensor.scan(60 + 90 * i).scan, rays_, motion_, T_imu_lidar, clock_shift);
    }
    return result;
  }

  Scene scene_;
  RayCaster rays_;
  Motion motion_;
  SimulationOptions options_;
};

INSTANTIATE_TEST_SUITE_P(
    Sensors, SelfCheck, ::testing::Values("mid360", "vlp16", "os0_32"), [](const auto& sensor) {
      return std::string(sensor.param);
    });

TEST_P(SelfCheck, PointsLieOnSurfacesWithinNoise) {
  const auto result = residuals(lidar().extrinsic());
  EXPECT_TRUE(result.is_consistent(0.01))
      << result.mean() << " " << result.sigma() << " " << result.misses();
}

TEST_P(SelfCheck, AClockShiftOf5MillisecondsFails) {
  EXPECT_FALSE(residuals(lidar().extrinsic(), 0.005).is_consistent(0.01));
}

TEST_P(SelfCheck, AnExtrinsicErrorOfACentimetreFails) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Pose T_imu_lidar = lidar().extrinsic() * shift(0.01 * Eigen::Vector3d::Unit(axis));
    EXPECT_FALSE(residuals(T_imu_lidar).is_consistent(0.01));
  }
}

/// Distance [m] from `p` to the surface of a box, from outside or inside.
double distance_to(const Box& box, const Eigen::Vector3d& p) {
  const Eigen::Vector3d beyond = (box.T_world_box.inverse() * p).cwiseAbs() - box.half_size;
  return std::abs(beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff()));
}

double distance_to(const Cylinder& cylinder, const Eigen::Vector3d& p) {
  const Eigen::Vector3d local = cylinder.T_world_cylinder.inverse() * p;
  const Eigen::Vector2d beyond(
      local.head<2>().norm() - cylinder.radius, std::abs(local.z()) - cylinder.half_height);
  return std::abs(beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff()));
}

/// Independent of the ray caster: plain distances to all solids.
TEST_P(SelfCheck, WithoutNoiseEachPointIsOnASolid) {
  options_.lidar.range_noise = 0.0;
  const Lidar sensor = lidar();
  const Scan scan = sensor.scan(300).scan;
  for (std::size_t i = 0; i < scan.points.size(); i += 37) {
    const TimedPoint& point = scan.points[i];
    const Pose T_world_lidar =
        motion_.pose(scan.t_begin + static_cast<double>(point.dt)) * sensor.extrinsic();
    const Eigen::Vector3d p =
        T_world_lidar * Eigen::Vector3f(point.x, point.y, point.z).cast<double>();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Box& box : scene_.boxes) {
      nearest = std::min(nearest, distance_to(box, p));
    }
    for (const Cylinder& cylinder : scene_.cylinders) {
      nearest = std::min(nearest, distance_to(cylinder, p));
    }
    EXPECT_LT(nearest, 1e-5);
  }
}

}  // namespace
}  // namespace nvm::sim
