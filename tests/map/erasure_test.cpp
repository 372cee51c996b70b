// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What is erased or visited by place, against all points looked at one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "nvm/map/voxel_map.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

TEST(Erase, LeavesExactlyWhatIsOutside) {
  std::mt19937_64 rng = test::rng();
  for (int round = 0; round < 20; ++round) {
    VoxelMap map;
    const test::Cloud cloud = test::uniform_cloud(5000, 5.0, {1.0, -2.0, 3.0}, rng);
    map.insert(cloud.points, cloud.normals);
    const Eigen::Vector3d a = cloud.points[0];
    const Eigen::Vector3d b = cloud.points[1];
    const Eigen::Vector3d min = a.cwiseMin(b);
    const Eigen::Vector3d max = a.cwiseMax(b);
    const auto inside = [&](const MapPoint& point) {
      return round % 2 == 0 ? ((point.position - min).minCoeff() >= 0.0 &&
                               (max - point.position).minCoeff() >= 0.0)
                            : (point.position - a).norm() <= 1.3;
    };
    std::set<std::array<double, 3>> expected;
    std::size_t erased = 0;
    for (const MapPoint& point : map.points()) {
      if (inside(point)) {
        ++erased;
      } else {
        expected.insert({point.position.x(), point.position.y(), point.position.z()});
      }
    }
    EXPECT_EQ(round % 2 == 0 ? map.erase_box(min, max) : map.erase_within(a, 1.3), erased);
    ASSERT_EQ(map.size(), expected.size());
    for (const MapPoint& point : map.points()) {
      ASSERT_EQ(expected.count({point.position.x(), point.position.y(), point.position.z()}), 1U);
    }
    // The map goes on working.
    map.insert(cloud.points, cloud.normals);
    VoxelMap::QueryContext context;
    Neighbor found;
    EXPECT_EQ(map.nearest(a, {1, 0.2, Gate::kSurfaces}, &found, context), 1U);
  }
}

TEST(Erase, EverythingInAnyWay) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(5000, 5.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap map;
  for (int way = 0; way < 4; ++way) {
    const InsertStats stats = map.insert(cloud.points, cloud.normals);
    ASSERT_EQ(map.size(), stats.stored);
    switch (way) {
      case 0:
        map.erase_box(Eigen::Vector3d::Constant(-1e6), Eigen::Vector3d::Constant(1e6));
        break;
      case 1:
        map.erase_within(Eigen::Vector3d::Zero(), 100.0);
        break;
      case 2:
        map.erase_voxels_beyond({1e4, 0, 0}, 10.0);
        break;
      default:
        map.clear();
        break;
    }
    EXPECT_TRUE(map.empty());
    EXPECT_EQ(map.voxel_count(), 0U);
    EXPECT_TRUE(map.points().empty());
  }
  map.insert(cloud.points, cloud.normals);
  const double nan = std::nan("");
  EXPECT_EQ(map.erase_box({nan, 0, 0}, {1, 1, 1}), 0U);
  EXPECT_EQ(map.erase_within({0, 0, 0}, nan), 0U);
  EXPECT_EQ(map.erase_within({0, 0, 0}, -1.0), 0U);
  EXPECT_EQ(map.erase_voxels_beyond({nan, 0, 0}, 1.0), 0U);
  EXPECT_EQ(map.erase_voxels_beyond({0, 0, 0}, nan), 0U);
  EXPECT_EQ(map.erase_voxels_beyond({0, 0, 0}, -1.0), 0U);
}

TEST(RadiusQuery, FindsWhatBruteForceFinds) {
  std::mt19937_64 rng = test::rng();
  VoxelMap map;
  const test::Cloud cloud = test::uniform_cloud(8000, 12.0, {3.0, 0.0, -8.0}, rng);
  map.insert(cloud.points, cloud.normals);
  const std::vector<MapPoint> points = map.points();
  for (const double radius : {0.0, 0.2, 1.0, 4.0, 100.0}) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d center = cloud.points[rng() % cloud.points.size()];
      const auto expected = std::count_if(points.begin(), points.end(), [&](const MapPoint& point) {
        return (point.position - center).norm() <= radius;
      });
      std::set<PointId> found;
      map.for_each_within(center, radius, [&](const Neighbor& neighbor) {
        EXPECT_EQ(map.position(neighbor.id), neighbor.position);
        found.insert(neighbor.id);
      });
      EXPECT_EQ(found.size(), static_cast<std::size_t>(expected));
    }
  }
  const auto none = [](const Neighbor&) { FAIL(); };
  map.for_each_within({std::nan(""), 0, 0}, 1.0, none);
  map.for_each_within({0, 0, 0}, -1.0, none);
}

// Brick indices that far away do not fit into 32 bits: converting them gave an endless loop.
// The squares of such lengths are too large for a double, and equal.
TEST(Erase, TellsLengthsApartWhoseSquaresOverflow) {
  const Eigen::Vector3d beyond(0.0, 1e300, 1e300);
  const Eigen::Vector3d corner(0.0, 1e300, 0.0);
  VoxelMap map;
  map.insert_unsided(std::vector<Eigen::Vector3d>{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  const auto count = [&](const Eigen::Vector3d& center, double radius) {
    int visits = 0;
    map.for_each_within(center, radius, [&](const Neighbor&) { ++visits; });
    return visits;
  };
  EXPECT_EQ(count(beyond, 1.41e300), 0);
  EXPECT_EQ(count(beyond, 1.42e300), 2);
  EXPECT_EQ(count(corner, 1e300), 2);
  EXPECT_EQ(count(corner, std::numeric_limits<double>::infinity()), 2);
  EXPECT_EQ(map.erase_within(beyond, 1.41e300), 0U);
  EXPECT_EQ(map.erase_voxels_beyond(beyond, 1.42e300), 0U);
  EXPECT_EQ(map.erase_voxels_beyond(beyond, 1.41e300), 2U);
  EXPECT_TRUE(map.empty());
}

TEST(Erase, FarAwayFindsNothing) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(2000, 12.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap map;
  map.insert(cloud.points, cloud.normals);
  const std::size_t size = map.size();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double far : {3.2e5, 2147483647 * 1.2 + 0.6, 2147483648 * 1.2, 1e10, 1e300}) {
    for (const double x : {far, -far}) {
      EXPECT_EQ(map.erase_within({x, 0, 0}, 0.1), 0U) << x;
      EXPECT_EQ(map.erase_within({0, x, x}, 0.1), 0U) << x;
      EXPECT_EQ(map.erase_box({x, 0, 0}, {x, 0.1, 0.1}), 0U) << x;
      map.for_each_within({0, 0, x}, 0.1, [](const Neighbor&) { FAIL(); });
    }
  }
  EXPECT_EQ(map.erase_box({1, 1, 1}, {-1, -1, -1}), 0U);
  EXPECT_EQ(map.erase_box({-inf, -inf, inf}, {inf, inf, inf}), 0U);
  EXPECT_EQ(map.size(), size);
  std::size_t found = 0;
  map.for_each_within({0, 0, 0}, inf, [&](const Neighbor&) { ++found; });
  map.for_each_within({1e10, 0, 0}, 1.1e10, [&](const Neighbor&) { ++found; });
  EXPECT_EQ(found, 2 * size);
  EXPECT_EQ(map.erase_box({-inf, -inf, -inf}, {inf, inf, inf}), size);
}
}  // namespace
}  // namespace nvm
