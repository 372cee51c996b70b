// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "nvm/map/voxel_map.hpp"
#include "support/map_oracle.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using test::Cloud;
using test::expect_right;
using test::MapOracle;

struct Case {
  double voxel_size;
  int max_surfaces;
  SurfaceRule rule;
};

class NearestOracle : public ::testing::TestWithParam<Case> {};

TEST_P(NearestOracle, AgreesWithBruteForce) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.voxel_size = GetParam().voxel_size;
  options.max_surfaces = GetParam().max_surfaces;
  options.surface_rule = GetParam().rule;
  options.min_point_distance = 0.03;
  options.capacity = 20000;
  for (Cloud& cloud : test::all_clouds(rng)) {
    SCOPED_TRACE(cloud.name);
    for (std::size_t i = 0; i < cloud.normals.size(); i += 4) {
      cloud.normals[i] *= 0.5F;  // a sighting
    }
    VoxelMap map(options);
    map.insert(cloud.points, cloud.normals);
    const MapOracle oracle(map);
    VoxelMap::QueryContext context;
    std::normal_distribution<double> jitter(0.0, 0.1);
    for (int i = 0; i < 150; ++i) {
      Eigen::Vector3d query(jitter(rng), jitter(rng), jitter(rng));
      Eigen::Vector3f normal = test::random_unit(rng);
      if (!cloud.points.empty()) {
        const std::size_t near = rng() % cloud.points.size();
        query += cloud.points[near];
        normal = i % 2 == 0 ? cloud.normals[near] : normal;
      }
      NearestSearch search;
      search.count = std::array<std::size_t, 4>{1, 5, 20, kMaxNeighbors}[rng() % 4];
      search.max_distance = std::array<double, 4>{0.05, 0.3, 1.0, 100.0}[rng() % 4];
      search.gate = i % 3 == 0 ? Gate::kPoints : Gate::kSurfaces;
      search.rings = std::array<int, 6>{1, 1, 2, 3, 9, std::numeric_limits<int>::max()}[rng() % 6];

      std::array<Neighbor, kMaxNeighbors> found;
      SCOPED_TRACE(::testing::Message() << search.count << " within " << search.max_distance);
      std::size_t count = map.nearest(query, search, found.data(), context);
      expect_right(oracle.candidates(query, nullptr, search), found.data(), count, search.count);
      count = map.nearest(query, normal, search, found.data(), context);
      expect_right(oracle.candidates(query, &normal, search), found.data(), count, search.count);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Maps,
    NearestOracle,
    ::testing::Values(
        Case{0.3, 2, SurfaceRule::kPaper},
        Case{0.5, 2, SurfaceRule::kSmallestAngle},
        Case{0.3, 4, SurfaceRule::kSmallestAngle},
        Case{1.0, 1, SurfaceRule::kPaper}));

// The context guesses how far the neighbours are; a wrong guess must cost time only.
TEST(Nearest, AnswersDoNotDependOnTheContext) {
  std::mt19937_64 rng = test::rng();
  VoxelMap map;
  const Cloud cloud = test::uniform_cloud(20000, 6.0, Eigen::Vector3d::Zero(), rng);
  map.insert(cloud.points, cloud.normals);
  VoxelMap::QueryContext used;
  for (std::size_t i = 0; i < 2000; ++i) {
    const Eigen::Vector3d query = 1.5 * cloud.points[rng() % cloud.points.size()];
    const NearestSearch search{1 + rng() % 20, 1.0, Gate::kSurfaces};
    VoxelMap::QueryContext fresh;
    std::array<Neighbor, kMaxNeighbors> a;
    std::array<Neighbor, kMaxNeighbors> b;
    const std::size_t count = map.nearest(query, cloud.normals[i], search, a.data(), used);
    ASSERT_EQ(count, map.nearest(query, cloud.normals[i], search, b.data(), fresh));
    for (std::size_t j = 0; j < count; ++j) {
      ASSERT_EQ(a[j].id, b[j].id);
    }
  }
}

// Boxes of voxels grow until the answer is settled: the answer is that of the last.
TEST(Nearest, FindsWhatIsFarAwayInItsRings) {
  VoxelMap map;
  map.insert(
      std::vector<Eigen::Vector3d>{{10.0, 0.1, 0.1}, {-4e4, 0.0, 0.0}},
      std::vector<Eigen::Vector3f>{{0, 0, 1}, {0, 0, -1}});
  VoxelMap::QueryContext context;
  std::array<Neighbor, 2> found;
  const Eigen::Vector3d query(0.1, 0.1, 0.1);
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  const auto count = [&](int rings, double max_distance) {
    return map.nearest(query, {2, max_distance, Gate::kSurfaces, rings}, found.data(), context);
  };
  EXPECT_EQ(count(32, 100.0), 0U);
  EXPECT_EQ(count(33, 100.0), 1U);  // voxel 33 of 0.3 m
  EXPECT_EQ(count(33, 9.8), 0U);
  EXPECT_EQ(count(std::numeric_limits<int>::max(), 1e9), 2U);
  EXPECT_NEAR(found[1].sq_distance, 40000.1F * 40000.1F, 1e3);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& normal : {up, Eigen::Vector3f(-up)}) {
    ASSERT_EQ(
        map.nearest(query, normal, {2, kInfinity, Gate::kSurfaces, 1 << 30}, found.data(), context),
        1U);
    EXPECT_EQ(map.normal(found[0].id), normal);
  }
  EXPECT_EQ(count(-5, 100.0), 0U);
  EXPECT_EQ(
      map.nearest({1e9, 0, 0}, {2, 1e12, Gate::kSurfaces, 1 << 30}, found.data(), context), 0U);
}

TEST(Nearest, KeepsTheSidesOfAThinWallApart) {
  std::mt19937_64 rng = test::rng();
  for (const double thickness : {0.03, 0.05, 0.15}) {
    const Cloud wall = test::thin_wall(20000, thickness, rng);
    VoxelMap map;
    map.insert(wall.points, wall.normals);
    VoxelMap::QueryContext context;
    std::array<Neighbor, kMaxNeighbors> found;
    for (std::size_t i = 0; i < wall.points.size(); ++i) {
      const std::size_t count = map.nearest(
          wall.points[i], wall.normals[i], {20, 1.0, Gate::kSurfaces}, found.data(), context);
      ASSERT_GT(count, 5U);
      for (std::size_t j = 0; j < count; ++j) {
        ASSERT_GT(map.normal(found[j].id).dot(wall.normals[i]), 0.0F);
      }
    }
  }
}

TEST(Nearest, PositionsAreThoseInserted) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.min_point_distance = 0.0;
  options.points_per_surface = 120;
  for (const Eigen::Vector3d& center :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2e5, -3e5, 1e5)}) {
    VoxelMap map(options);
    const Cloud cloud = test::uniform_cloud(3000, 3.0, center, rng);
    ASSERT_EQ(map.insert(cloud.points, cloud.normals).stored, cloud.points.size());
    VoxelMap::QueryContext context;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      Neighbor nearest;
      ASSERT_EQ(map.nearest(cloud.points[i], {1, 1.0, Gate::kSurfaces}, &nearest, context), 1U);
      EXPECT_LT((nearest.position - cloud.points[i]).norm(), 33e-6);
      EXPECT_EQ(map.position(nearest.id), nearest.position);
      EXPECT_GT(map.normal(nearest.id).dot(cloud.normals[i]), std::cos(0.012F));
    }
  }
}

TEST(Nearest, FindsNothingForBadInput) {
  std::mt19937_64 rng = test::rng();
  VoxelMap map;
  const Cloud cloud = test::uniform_cloud(1000, 1.0, Eigen::Vector3d::Zero(), rng);
  map.insert(cloud.points, cloud.normals);
  VoxelMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> found;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  for (const double bad : {kNan, kInf, -kInf, 1e300, -1e9}) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      point[axis] = bad;
      EXPECT_EQ(map.nearest(point, {5, 1.0, Gate::kSurfaces}, found.data(), context), 0U);
      EXPECT_EQ(map.nearest(point, up, {5, 1.0, Gate::kSurfaces}, found.data(), context), 0U);
      EXPECT_EQ(
          map.nearest(
              Eigen::Vector3d::Zero(),
              point.cast<float>(),
              {5, 1.0, Gate::kSurfaces},
              found.data(),
              context),
          0U);
    }
    if (!(bad > 0.0)) {
      EXPECT_EQ(
          map.nearest(Eigen::Vector3d::Zero(), {5, bad, Gate::kSurfaces}, found.data(), context),
          0U);
    }
  }
  EXPECT_EQ(
      map.nearest(
          Eigen::Vector3d::Zero(),
          Eigen::Vector3f::Zero(),
          {5, 1.0, Gate::kSurfaces},
          found.data(),
          context),
      0U);
  EXPECT_EQ(
      map.nearest(
          Eigen::Vector3d::Zero(), 2.0F * up, {5, 1.0, Gate::kSurfaces}, found.data(), context),
      0U);
  EXPECT_EQ(
      map.nearest(Eigen::Vector3d::Zero(), {0, 1.0, Gate::kSurfaces}, found.data(), context), 0U);
  EXPECT_EQ(
      map.nearest(Eigen::Vector3d::Zero(), {1000000, 10.0, Gate::kSurfaces}, found.data(), context),
      kMaxNeighbors);
}

TEST(Nearest, NeverAnswersWithALaneThatHoldsNoPoint) {
  std::mt19937_64 rng = test::rng();
  constexpr double kVoxel = 0.3;
  MapOptions options;
  options.voxel_size = kVoxel;
  VoxelMap map(options);
  VoxelMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> found;
  for (int round = 0; round < 5000; ++round) {
    // Voxel and query at either end of each axis, or anywhere between: all that 27 voxels allow.
    Eigen::Vector3d point;
    Eigen::Vector3d query;
    for (int axis = 0; axis < 3; ++axis) {
      const auto place = [&] { return (0.5 + static_cast<double>(rng() % 8191)) / 8192.0; };
      const double voxel = static_cast<double>(rng() % 2000) - 1000.0;
      point[axis] = kVoxel * (voxel + (rng() % 2 == 0 ? 1e-6 : place()));
      query[axis] = kVoxel * (voxel + static_cast<double>(rng() % 3) - 1.0 +
                              (rng() % 2 == 0 ? 1.0 - 1e-6 : place()));
    }
    map.clear();
    map.insert_unsided(std::array<Eigen::Vector3d, 1>{point});
    ASSERT_EQ(map.nearest(query, {20, 1e300, Gate::kSurfaces}, found.data(), context), 1U);
    ASSERT_NEAR(found[0].sq_distance, (point - query).squaredNorm(), 2e-4);
  }
}

}  // namespace
}  // namespace nvm
