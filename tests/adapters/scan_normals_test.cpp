// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/common/scan_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/host_point.hpp"

namespace nvm {
namespace {

/// The share of the points that get the normal `expected`.
double share_with_normal(
    test::HostPoints scan, const Eigen::Vector3f& expected, adapters::ScanNormals normals) {
  const test::HostPoints full = scan;
  normals.write(scan, full);
  std::size_t found = 0;
  for (const test::HostPoint& point : scan) {
    found += adapters::normal_field(point).dot(expected) > 0.99F ? 1U : 0U;
  }
  return static_cast<double>(found) / static_cast<double>(scan.size());
}

// A wall at 2 m as FAST_LIO's point_filter_num of 3 leaves it: five points in the radius of 17 cm.
TEST(ScanNormals, FindTheNormalsOfAThinnedWall) {
  test::HostPoints wall;
  for (int i = -8; i <= 8; ++i) {
    for (int j = -8; j <= 8; ++j) {
      wall.push_back(test::host_point({2.0, 0.13 * i, 0.13 * j}));
    }
  }
  EXPECT_GT(share_with_normal(wall, -Eigen::Vector3f::UnitX(), adapters::ScanNormals()), 0.95);
  EXPECT_LT(
      share_with_normal(wall, -Eigen::Vector3f::UnitX(), adapters::ScanNormals(NormalOptions())),
      0.5)
      << "the test shows nothing";
}

// Two rings of a VLP-16 on the floor, 0.4 m apart: each is a line in the radius of 31 cm.
TEST(ScanNormals, FindTheFloorUnderASpinningSensor) {
  test::HostPoints floor;
  for (const double radius : {5.2, 5.6}) {
    for (int i = 0; i < 600; ++i) {
      const double azimuth = 0.010472 * i;
      floor.push_back(
          test::host_point({radius * std::cos(azimuth), radius * std::sin(azimuth), -1.3}));
    }
  }
  EXPECT_GT(share_with_normal(floor, Eigen::Vector3f::UnitZ(), adapters::ScanNormals()), 0.95);
  EXPECT_LT(
      share_with_normal(floor, Eigen::Vector3f::UnitZ(), adapters::ScanNormals(NormalOptions())),
      0.5)
      << "the test shows nothing";
}

// A single ring on the floor is a line: its points get sightings, which turn with the sensor.
TEST(ScanNormals, WriteSightingsWhereTheScanHasNoPlane) {
  test::HostPoints ring;
  for (int i = 0; i < 600; ++i) {
    const double azimuth = 0.010472 * i;
    ring.push_back(test::host_point({5.0 * std::cos(azimuth), 5.0 * std::sin(azimuth), -1.3}));
  }
  const test::HostPoints full = ring;
  adapters::ScanNormals().write(ring, full, {0.0, 0.0, 0.2});
  const Eigen::Vector3f to_sensor = Eigen::Vector3f(-5.0F, 0.0F, 1.5F).normalized();
  EXPECT_LT((adapters::normal_field(ring[0]) - 0.5F * to_sensor).norm(), 1e-5F);

  Eigen::Matrix3d quarter_turn;
  quarter_turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  test::HostPoint turned;
  adapters::rotate_normal(quarter_turn, ring[0], turned);
  const Eigen::Vector3f turned_view(-to_sensor.y(), to_sensor.x(), to_sensor.z());
  EXPECT_LT((adapters::normal_field(turned) - 0.5F * turned_view).norm(), 1e-5F);
}

}  // namespace
}  // namespace nvm
