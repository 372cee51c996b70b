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

}  // namespace
}  // namespace nvm
