// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "nvm/map/voxel_map.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Normals = std::vector<Eigen::Vector3f>;

constexpr double kStep = 0.3 / 8192;  // of the lattice [m]
const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

MapOptions merging(int max_merged_points) {
  MapOptions options;
  options.max_merged_points = max_merged_points;
  options.space_across_voxels = true;
  return options;
}

Eigen::Vector3d only_point(const VoxelMap& map) {
  EXPECT_EQ(map.size(), 1U);
  return map.points().front().position;
}

/// A point after others came too close to it, at these heights above it and a little aside.
Eigen::Vector3d merged_with(const MapOptions& options, const std::vector<double>& heights) {
  VoxelMap map(options);
  map.insert(Points{{0.1, 0.1, 0.1}}, Normals{kUp});
  for (const double height : heights) {
    map.insert(Points{{0.12, 0.09, 0.1 + height}}, Normals{kUp});
  }
  return only_point(map);
}

TEST(PointMerger, MovesAPointAlongTheNormalToTheMean) {
  const Eigen::Vector3d moved = merged_with(merging(8), {0.004, -0.002, 0.006});
  EXPECT_NEAR(moved.z(), 0.1 + 0.002, 3 * kStep);
  EXPECT_NEAR(moved.x(), 0.1, kStep);
  EXPECT_NEAR(moved.y(), 0.1, kStep);
}

TEST(PointMerger, StopsWhenThePointStandsForEnough) {
  const Eigen::Vector3d moved = merged_with(merging(3), {0.006, 0.0, 0.02, 0.02});
  EXPECT_NEAR(moved.z(), 0.1 + 0.002, 3 * kStep);
  EXPECT_NEAR(merged_with(merging(1), {0.02, 0.02}).z(), 0.1, kStep);
}

TEST(PointMerger, LeavesPointsOfOtherSurfacesAlone) {
  VoxelMap map(merging(8));
  map.insert(Points{{0.1, 0.1, 0.1}}, Normals{kUp});
  const Eigen::Vector3d before = only_point(map);
  const Eigen::Vector3f slanting = Eigen::Vector3f(0.0F, 0.6F, 0.8F);
  map.insert(Points{{0.1, 0.1, 0.103}}, Normals{slanting});
  map.insert(Points{{0.1, 0.1, 0.13}}, Normals{kUp});  // more than a quarter of the distance
  EXPECT_EQ(only_point(map), before);
  map.insert(Points{{0.1, 0.1, 0.097}}, Normals{-kUp});  // the other side, stored beside it
  EXPECT_EQ(map.size(), 2U);
  EXPECT_EQ(map.points().front().position, before);
}

TEST(PointMerger, ReachesOverVoxelBordersButKeepsPointsInTheirVoxels) {
  VoxelMap map(merging(8));
  map.insert(Points{{0.1, 0.1, 0.301}}, Normals{kUp});
  for (int i = 0; i < 7; ++i) {  // all from the voxel below
    map.insert(Points{{0.1, 0.1, 0.295}}, Normals{kUp});
  }
  EXPECT_NEAR(only_point(map).z(), 0.3, kStep);
  EXPECT_GT(only_point(map).z(), 0.3);
}

TEST(PointMerger, AveragesTheNoiseOfAFloorOut) {
  std::mt19937_64 rng = test::rng();
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  std::normal_distribution<double> noise(0.0, 0.003);
  VoxelMap still(merging(1));
  VoxelMap merged(merging(16));
  for (int i = 0; i < 60'000; ++i) {
    const Points point{{place(rng), place(rng), 0.3 + noise(rng)}};  // along a border
    still.insert(point, Normals{kUp});
    merged.insert(point, Normals{kUp});
  }
  const auto rms = [](const VoxelMap& map) {
    double sum = 0.0;
    map.for_each_point([&](const MapPoint& p) { sum += std::pow(p.position.z() - 0.3, 2); });
    return std::sqrt(sum / static_cast<double>(map.size()));
  };
  EXPECT_GT(rms(still), 0.0025);
  EXPECT_LT(rms(merged), 0.0012);
  VoxelMap::QueryContext context;
  merged.for_each_point([&](const MapPoint& p) {  // each is where queries look for it
    Neighbor nearest;
    ASSERT_EQ(merged.nearest(p.position, {1, 0.01}, &nearest, context), 1U);
    EXPECT_EQ(nearest.sq_distance, 0.0F);
  });
}

}  // namespace
}  // namespace nvm
