// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/lidar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/angles.hpp"
#include "sim/scene_file.hpp"

namespace nvm::sim {
namespace {

double elevation_deg(const Eigen::Vector3d& direction) {
  return std::asin(direction.z()) * 180.0 / M_PI;
}

class Sensors : public ::testing::TestWithParam<SensorModel> {};

INSTANTIATE_TEST_SUITE_P(
    All, Sensors, ::testing::ValuesIn(sensor_models()), [](const auto& parameter) {
      return parameter.param.name;
    });

TEST_P(Sensors, FiresUnitDirectionsInOrderOfTimeWithinTheScan) {
  const SensorModel& sensor = GetParam();
  for (const double scan_rate : {5.0, 10.0, 20.0}) {
    double previous = 0.0;
    for (std::size_t shot = 0; shot < sensor.shots_per_scan(scan_rate); ++shot) {
      const Firing firing = sensor.firing(3, shot, scan_rate);
      ASSERT_GE(firing.dt, previous);
      ASSERT_LT(firing.dt, 1.0 / scan_rate);
      ASSERT_NEAR(firing.direction.norm(), 1.0, 1e-12);
      previous = firing.dt;
    }
  }
}

TEST_P(Sensors, FiresItsRateOfShots) {
  const SensorModel& sensor = GetParam();
  EXPECT_NEAR(
      static_cast<double>(sensor.shots_per_scan(10.0)) * 10.0, sensor.points_per_second, 1.0);
}

TEST(SensorModel, SpinningSensorsRepeatAndOthersDoNot) {
  for (const SensorModel& sensor : sensor_models()) {
    double repeat = 0.0;
    for (std::size_t shot = 0; shot < 1000; ++shot) {
      const Eigen::Vector3d first = sensor.firing(0, shot, 10.0).direction;
      repeat = std::max(repeat, (first - sensor.firing(1, shot, 10.0).direction).norm());
    }
    EXPECT_EQ(repeat < 1e-9, sensor.pattern == ScanPattern::kSpinning) << sensor.name;
  }
}

TEST(SensorModel, Mid360CoversItsFieldOfViewEvenlyInASecond) {
  const SensorModel& sensor = find_sensor("mid360");
  std::array<int, 36> azimuths{};
  std::array<int, 59> elevations{};
  for (std::size_t scan = 0; scan < 10; ++scan) {
    for (std::size_t shot = 0; shot < 20000; ++shot) {
      const Eigen::Vector3d d = sensor.firing(scan, shot, 10.0).direction;
      const double azimuth_deg = std::atan2(d.y(), d.x()) * 180.0 / M_PI + 180.0;
      ++azimuths[std::min(static_cast<std::size_t>(azimuth_deg / 10.0), std::size_t{35})];
      const double above = std::clamp(elevation_deg(d) + 7.0, 0.0, 58.999);
      ++elevations[static_cast<std::size_t>(above)];
    }
  }
  EXPECT_GT(*std::min_element(azimuths.begin(), azimuths.end()), 0.8 * 200000 / 36);
  EXPECT_LT(*std::max_element(azimuths.begin(), azimuths.end()), 1.2 * 200000 / 36);
  EXPECT_GT(*std::min_element(elevations.begin(), elevations.end()), 0.8 * 200000 / 59);
  EXPECT_LT(*std::max_element(elevations.begin(), elevations.end()), 1.2 * 200000 / 59);
}

TEST(SensorModel, AviaLooksAheadThroughItsCone) {
  const SensorModel& sensor = find_sensor("avia");
  double widest = 0.0;
  double highest = 0.0;
  for (std::size_t shot = 0; shot < 24000; ++shot) {
    const Eigen::Vector3d d = sensor.firing(0, shot, 10.0).direction;
    widest = std::max(widest, std::abs(std::atan2(d.y(), d.x())) * 180.0 / M_PI);
    highest = std::max(highest, std::abs(elevation_deg(d)));
  }
  EXPECT_NEAR(widest, 35.2, 0.5);
  EXPECT_NEAR(highest, 38.6, 0.5);
}

TEST(SensorModel, Vlp16HasSixteenElevationsTwoDegreesApart) {
  const SensorModel& sensor = find_sensor("vlp16");
  std::set<int> elevations;
  for (std::size_t shot = 0; shot < 16; ++shot) {
    elevations.insert(
        static_cast<int>(std::lround(elevation_deg(sensor.firing(0, shot, 10.0).direction))));
  }
  std::set<int> expected;
  for (int elevation = -15; elevation <= 15; elevation += 2) {
    expected.insert(elevation);
  }
  EXPECT_EQ(elevations, expected);
}

/// A room of 10 x 8 x 3 m with a column, seen by a Mid-360 that stands in it.
class LidarInARoom : public ::testing::Test {
 protected:
  LidarInARoom()
      : scene_(parse_scene(
            "hulls: [{name: room, min: [-5, -4, 0], max: [5, 4, 3]}]\n"
            "cylinders: [{name: column, bottom: [2, 1, 0], radius: 0.2, height: 3}]\n"
            "route: {waypoints: [[-2, -1], [2, -1]]}\n",
            "room.yaml")),
        rays_(scene_),
        motion_(scene_.route, {}, 1, 10.0) {}

  SimulatedScan scan(const LidarOptions& options, std::size_t index = 60) const {
    return Lidar(find_sensor("mid360"), options, {scene_, rays_, motion_}, 1).scan(index);
  }

  Scene scene_;
  RayCaster rays_;
  Motion motion_;
};

double share_of(const SimulatedScan& scan, Origin origin) {
  const auto count = std::count_if(scan.truth.begin(), scan.truth.end(), [&](const auto& truth) {
    return truth.origin == origin;
  });
  return static_cast<double>(count) / static_cast<double>(scan.truth.size());
}

TEST_F(LidarInARoom, ReturnsEveryShotWhenNothingErrs) {
  EXPECT_EQ(scan({}).scan.points.size(), 20000U);
  EXPECT_EQ(share_of(scan({}), Origin::kSurface), 1.0);
}

TEST_F(LidarInARoom, LosesAndInventsTheConfiguredShares) {
  LidarOptions options;
  options.dropouts = 0.1;
  options.outliers = 0.05;
  const SimulatedScan result = scan(options);
  EXPECT_NEAR(static_cast<double>(result.scan.points.size()) / 20000.0, 0.9, 0.02);
  EXPECT_NEAR(share_of(result, Origin::kOutlier), 0.05, 0.01);
}

TEST_F(LidarInARoom, MixesPixelsAtEdgesOnly) {
  LidarOptions options;
  options.mixed_pixels = 1.0;
  options.range_noise = 0.0;
  const SimulatedScan mixed = scan(options);
  const SimulatedScan clean = scan({});
  const double share = share_of(mixed, Origin::kMixedPixel);
  EXPECT_GT(share, 1e-4);
  EXPECT_LT(share, 0.02);
  ASSERT_EQ(mixed.scan.points.size(), clean.scan.points.size());
}

TEST_F(LidarInARoom, KeepsWithinItsRanges) {
  LidarOptions options;
  options.min_range = 2.0;
  options.max_range = 4.0;
  for (const TimedPoint& point : scan(options).scan.points) {
    const double range = Eigen::Vector3f(point.x, point.y, point.z).norm();
    EXPECT_GE(range, 2.0 - 1e-6);
    EXPECT_LE(range, 4.0 + 1e-6);
  }
}

TEST_F(LidarInARoom, NoiseGrowsWithRangeAndIncidenceWhenAsked) {
  const auto spread = [&](const LidarOptions& options) {
    LidarOptions noiseless = options;
    noiseless.range_noise = 0.0;
    noiseless.range_noise_per_metre = 0.0;
    noiseless.range_noise_per_tangent = 0.0;
    const auto noisy = scan(options).scan.points;
    const auto exact = scan(noiseless).scan.points;
    double sum = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const Eigen::Vector3f difference(
          noisy[i].x - exact[i].x, noisy[i].y - exact[i].y, noisy[i].z - exact[i].z);
      sum += difference.squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(exact.size()));
  };
  LidarOptions options;
  EXPECT_NEAR(spread(options), 0.01, 2e-4);
  options.range_noise_per_metre = 0.005;
  const double with_range = spread(options);
  EXPECT_GT(with_range, 0.015);
  options.range_noise_per_tangent = 0.01;
  EXPECT_GT(spread(options), with_range + 0.003);
}

TEST_F(LidarInARoom, RangesAreMultiplesOfTheQuantum) {
  LidarOptions options;
  options.range_quantum = 0.02;
  for (const TimedPoint& point : scan(options).scan.points) {
    const double steps = Eigen::Vector3d(point.x, point.y, point.z).norm() / options.range_quantum;
    EXPECT_NEAR(steps, std::round(steps), 1e-3);
  }
}

TEST_F(LidarInARoom, BiasesLengthenDarkAndSlantingReturns) {
  LidarOptions options;
  options.range_noise = 0.0;
  const auto exact = scan(options).scan.points;
  options.range_bias_dark = 0.02;  // the default reflectivity is a half
  const auto dark = scan(options).scan.points;
  options.range_bias_dark = 0.0;
  options.range_bias_per_tangent = 0.01;
  const auto slanting = scan(options).scan.points;
  double longest = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const auto range = [](const TimedPoint& p) { return Eigen::Vector3d(p.x, p.y, p.z).norm(); };
    ASSERT_NEAR(range(dark[i]) - range(exact[i]), 0.01, 1e-5);
    ASSERT_GE(range(slanting[i]) - range(exact[i]), -1e-5);
    longest = std::max(longest, range(slanting[i]) - range(exact[i]));
  }
  EXPECT_GT(longest, 0.03);  // at 72 degrees
  EXPECT_LT(longest, 0.1);   // it ends to grow at a cosine of 0.1
}

TEST_F(LidarInARoom, IntensityFollowsReflectivityAndIncidence) {
  LidarOptions options;
  options.range_noise = 0.0;
  for (const TimedPoint& point : scan(options).scan.points) {
    EXPECT_GE(point.intensity, 0.0F);
    EXPECT_LE(point.intensity, 127.5F);
  }
}

}  // namespace
}  // namespace nvm::sim
