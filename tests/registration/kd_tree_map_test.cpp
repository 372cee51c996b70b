// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/map/kd_tree_map.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/rng.hpp"

namespace nvm {
namespace {

const Eigen::Vector3f kAnyNormal = Eigen::Vector3f::UnitZ();

TEST(KdTreeMap, ModelsTheMapConcept) {
  EXPECT_TRUE(is_map_v<KdTreeMap>);
  EXPECT_FALSE(is_map_v<std::vector<int>>);
}

TEST(KdTreeMap, AgreesWithBruteForce) {
  auto rng = test::rng();
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  const auto random_point = [&] {
    return Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng));
  };
  KdTreeMap map(0.1);
  for (int batch = 0; batch < 3; ++batch) {
    std::vector<Eigen::Vector3d> points(700);
    std::generate(points.begin(), points.end(), random_point);
    map.insert_unsided(points);
  }
  KdTreeMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> found;
  for (int query = 0; query < 200; ++query) {
    const Eigen::Vector3d point = random_point();
    const NearestSearch search{8, 0.3};
    const std::size_t count = map.nearest(point, kAnyNormal, search, found.data(), context);
    std::vector<float> expected;
    for (const Eigen::Vector3d& stored : map.points()) {
      if ((stored - point).norm() <= search.max_distance) {
        expected.push_back(static_cast<float>((stored - point).squaredNorm()));
      }
    }
    std::sort(expected.begin(), expected.end());
    expected.resize(std::min(expected.size(), search.count));
    ASSERT_EQ(count, expected.size());
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_FLOAT_EQ(found[i].sq_distance, expected[i]);
      EXPECT_EQ(found[i].position, map.points()[found[i].id]);
    }
  }
}

TEST(KdTreeMap, KeepsOnePointPerCellAndCountsTheRest) {
  KdTreeMap map(0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const InsertStats stats = map.insert_unsided(std::vector<Eigen::Vector3d>{
      {0.01, 0.01, 0.01},
      {0.09, 0.01, 0.01},
      {-0.01, 0.01, 0.01},
      {nan, 0.0, 0.0},
      {1e9, 0.0, 0.0}});
  EXPECT_EQ(stats.stored, 2U);
  EXPECT_EQ(stats.too_close, 1U);
  EXPECT_EQ(stats.non_finite, 1U);
  EXPECT_EQ(stats.out_of_range, 1U);
  EXPECT_EQ(map.size(), 2U);
}

TEST(KdTreeMap, DistanceIsInclusive) {
  KdTreeMap map;
  map.insert_unsided(std::vector<Eigen::Vector3d>{{1.0, 0.0, 0.0}});
  KdTreeMap::QueryContext context;
  Neighbor found{};
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  EXPECT_EQ(map.nearest(origin, kAnyNormal, {1, 1.0}, &found, context), 1U);
  EXPECT_EQ(map.nearest(origin, kAnyNormal, {1, 0.999}, &found, context), 0U);
}

TEST(KdTreeMap, EmptyMapAndBadQueriesFindNothing) {
  KdTreeMap map;
  KdTreeMap::QueryContext context;
  Neighbor found{};
  EXPECT_EQ(map.nearest(Eigen::Vector3d::Zero(), kAnyNormal, {}, &found, context), 0U);
  map.insert_unsided(std::vector<Eigen::Vector3d>{});
  EXPECT_EQ(map.nearest(Eigen::Vector3d::Zero(), kAnyNormal, {}, &found, context), 0U);
  map.insert_unsided(std::vector<Eigen::Vector3d>{{1.0, 0.0, 0.0}});
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(map.nearest({inf, 0.0, 0.0}, kAnyNormal, {}, &found, context), 0U);
  const Eigen::Vector3d near(1.1, 0.0, 0.0);
  found.id = 77;
  EXPECT_EQ(map.nearest(near, kAnyNormal, {0, 1.0}, &found, context), 0U);
  EXPECT_EQ(map.nearest(near, kAnyNormal, {1, -1.0}, &found, context), 0U);
  EXPECT_EQ(map.nearest(near, kAnyNormal, {1, std::nan("")}, &found, context), 0U);
  EXPECT_EQ(found.id, 77U);
  EXPECT_EQ(map.nearest(near, kAnyNormal, {1, inf}, &found, context), 1U);
  EXPECT_THROW(KdTreeMap(0.0), std::invalid_argument);
}

TEST(VoxelSet, KnowsCellsOnEitherSideOfZeroAndForgetsWhenCleared) {
  VoxelSet set(0.5);
  using Insertion = VoxelSet::Insertion;
  EXPECT_EQ(set.insert({0.1, 0.1, 0.1}), Insertion::kNewCell);
  EXPECT_EQ(set.insert({0.4, 0.4, 0.4}), Insertion::kOccupied);
  EXPECT_EQ(set.insert({-0.1, 0.1, 0.1}), Insertion::kNewCell);
  EXPECT_EQ(set.size(), 2U);
  set.clear();
  EXPECT_EQ(set.size(), 0U);
  EXPECT_EQ(set.insert({0.1, 0.1, 0.1}), Insertion::kNewCell);
}

TEST(VoxelSet, GrowsWithoutForgetting) {
  VoxelSet set(1.0);
  for (int pass = 0; pass < 2; ++pass) {
    for (int i = 0; i < 30000; ++i) {
      const Eigen::Vector3d point(i % 31 - 15 + 0.5, i / 31 % 31 - 15 + 0.5, i / 961 + 0.5);
      ASSERT_EQ(
          set.insert(point),
          pass == 0 ? VoxelSet::Insertion::kNewCell : VoxelSet::Insertion::kOccupied);
    }
  }
  EXPECT_EQ(set.size(), 30000U);
}

}  // namespace
}  // namespace nvm
