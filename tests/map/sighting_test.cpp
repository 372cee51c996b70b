// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/map/sighting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "nvm/map/serialization.hpp"
#include "nvm/map/voxel_map.hpp"
#include "support/map_oracle.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Normals = std::vector<Eigen::Vector3f>;

const Eigen::Vector3f kUpward = Eigen::Vector3f::UnitZ();
const Eigen::Vector3f kSlanting = Eigen::Vector3f(0.8F, 0.0F, 0.6F);  // 53 degrees from it

std::size_t found(const VoxelMap& map, const Eigen::Vector3d& point, const Eigen::Vector3f& n) {
  VoxelMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> out;
  return map.nearest(point, n, {kMaxNeighbors, 0.5, Gate::kSurfaces}, out.data(), context);
}

TEST(Sighting, IsHalfTheViewDirection) {
  const Eigen::Vector3f seen = sighting(Eigen::Vector3d(1.0, 2.0, 3.0), {1.0, 2.0, 7.0});
  EXPECT_EQ(seen, 0.5F * kUpward);
  EXPECT_TRUE(is_sighting(seen));
  EXPECT_TRUE(sighting(Eigen::Vector3d(1.0, 2.0, 3.0), {1.0, 2.0, 3.0}).isZero());
  for (const float length : {0.0F, 0.4F, 0.6F, 1.0F, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_FALSE(is_sighting(length * kUpward)) << length;
  }
}

TEST(Sighting, IsFoundByASightingOnly) {
  VoxelMap map;
  map.insert(Points{{0.05, 0.05, 0.05}, {0.25, 0.25, 0.05}}, Normals{0.5F * kSlanting, kUpward});
  EXPECT_EQ(found(map, {0.1, 0.1, 0.05}, kUpward), 1U);
  EXPECT_EQ(found(map, {0.1, 0.1, 0.05}, 0.5F * kUpward), 2U);
  EXPECT_EQ(found(map, {0.1, 0.1, 0.05}, -0.5F * kUpward), 0U);
  EXPECT_EQ(found(map, {0.1, 0.1, 0.05}, 0.7F * kUpward), 0U) << "neither a normal nor a sighting";
}

TEST(Sighting, IsGivenBackAsItWas) {
  std::mt19937_64 rng = test::rng();
  VoxelMap map;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3f seen = 0.5F * test::random_unit(rng);
    map.clear();
    EXPECT_EQ(map.insert(Points{{0.1, 0.1, 0.1}}, Normals{seen}).stored, 1U);
    const Eigen::Vector3f stored = map.points()[0].normal;
    EXPECT_TRUE(is_sighting(stored));
    EXPECT_LT((stored - seen).norm(), 0.01F);
  }
}

TEST(Sighting, GivesItsPlaceToAPointWithANormal) {
  VoxelMap map;
  map.insert(Points{{0.1, 0.1, 0.1}}, Normals{0.5F * kSlanting});
  const InsertStats stats = map.insert(Points{{0.12, 0.1, 0.1}}, Normals{kUpward});
  EXPECT_EQ(stats.settled, 1U);
  EXPECT_EQ(stats.stored + stats.too_close, 0U);
  ASSERT_EQ(map.size(), 1U);
  EXPECT_NEAR(map.points()[0].position.x(), 0.12, 1e-4);
  EXPECT_GT(map.points()[0].normal.dot(kUpward), 0.99F);
  // Once settled it stays, and no sighting takes its place.
  EXPECT_EQ(map.insert(Points{{0.1, 0.1, 0.1}}, Normals{kUpward}).too_close, 1U);
  EXPECT_EQ(map.insert(Points{{0.1, 0.1, 0.1}}, Normals{0.5F * kUpward}).too_close, 1U);
  EXPECT_NEAR(map.points()[0].position.x(), 0.12, 1e-4);
}

TEST(Sighting, LeavesRoomInAFullSurface) {
  MapOptions options;
  options.points_per_surface = 10;
  options.min_point_distance = 0.01;
  VoxelMap map(options);
  Points points;
  for (int i = 0; i < 12; ++i) {
    points.emplace_back(0.02 + 0.02 * i, 0.1, 0.1);
  }
  EXPECT_EQ(map.insert(points, Normals(12, 0.5F * kUpward)).surface_full, 2U);
  EXPECT_EQ(map.insert(Points{{0.25, 0.1, 0.1}}, Normals{kUpward}).settled, 1U);
  EXPECT_EQ(map.size(), 10U);
  EXPECT_EQ(found(map, {0.25, 0.1, 0.1}, kUpward), 1U);
}

TEST(Sighting, DoesNotTurnItsSurface) {
  VoxelMap map;
  map.insert(
      Points{{0.05, 0.05, 0.1}, {0.15, 0.05, 0.1}, {0.25, 0.05, 0.1}, {0.05, 0.25, 0.1}},
      Normals{0.5F * kSlanting, 0.5F * kSlanting, kUpward, 0.5F * kSlanting});
  // 105 degrees from the sightings, 52 from the normal.
  const Eigen::Vector3f other(-0.788F, 0.0F, 0.616F);
  EXPECT_EQ(found(map, {0.15, 0.1, 0.1}, other.normalized()), 1U);
}

TEST(Sighting, TellsTheFacesOfAThinWallApart) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(10000, 0.05, rng);
  VoxelMap map;
  Normals seen;
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    const double front = wall.normals[i].y() > 0.0F ? 2.0 : -2.0;
    seen.push_back(sighting(wall.points[i], {0.0, test::kWallY + front, 0.0}));
  }
  map.insert(wall.points, seen);
  VoxelMap::QueryContext context;
  std::array<Neighbor, kMaxNeighbors> out;
  for (std::size_t i = 0; i < wall.points.size(); i += 7) {
    const NearestSearch search{20, 0.3, Gate::kSurfaces};
    const std::size_t count = map.nearest(wall.points[i], seen[i], search, out.data(), context);
    ASSERT_GT(count, 3U);
    for (std::size_t j = 0; j < count; ++j) {
      const bool same_face = (out[j].position.y() > test::kWallY) == (wall.normals[i].y() > 0.0F);
      // Oblique views of the two faces differ by less than the 100 degrees of the gate.
      const bool is_oblique =
          std::abs(wall.points[i].x()) > 1.0 || std::abs(wall.points[i].z()) > 1.0;
      EXPECT_TRUE(same_face || is_oblique);
    }
  }
}

TEST(Sighting, AnswersAgreeWithBruteForce) {
  std::mt19937_64 rng = test::rng();
  std::normal_distribution<double> jitter(0.0, 0.05);
  for (test::Cloud cloud : test::all_clouds(rng)) {
    SCOPED_TRACE(cloud.name);
    for (Eigen::Vector3f& normal : cloud.normals) {
      normal *= rng() % 3 == 0 ? 0.5F : 1.0F;
    }
    MapOptions options;
    options.min_point_distance = 0.03;
    VoxelMap map(options);
    map.insert(cloud.points, cloud.normals);
    const test::MapOracle oracle(map);
    VoxelMap::QueryContext context;
    std::array<Neighbor, kMaxNeighbors> out;
    for (std::size_t i = 0; i < 200 && !cloud.points.empty(); ++i) {
      const std::size_t near = rng() % cloud.points.size();
      const Eigen::Vector3f normal = cloud.normals[near];
      const Eigen::Vector3d query =
          cloud.points[near] + Eigen::Vector3d(jitter(rng), jitter(rng), jitter(rng));
      const NearestSearch search{
          std::array<std::size_t, 3>{1, 5, 20}[i % 3],
          0.3,
          i % 4 == 0 ? Gate::kPoints : Gate::kSurfaces};
      const std::size_t count = map.nearest(query, normal, search, out.data(), context);
      test::expect_right(
          oracle.candidates(query, &normal, search), out.data(), count, search.count);
    }
  }
}

TEST(Sighting, SurvivesAFile) {
  std::mt19937_64 rng = test::rng();
  test::Cloud cloud = test::uniform_cloud(3000, 2.0, Eigen::Vector3d::Zero(), rng);
  for (Eigen::Vector3f& normal : cloud.normals) {
    normal *= rng() % 2 == 0 ? 0.5F : 1.0F;
  }
  VoxelMap map;
  map.insert(cloud.points, cloud.normals);
  VoxelMap loaded = MapArchive::read(MapArchive::write(map));
  EXPECT_EQ(MapArchive::write(map), MapArchive::write(loaded));
  map.insert(cloud.points, cloud.normals);
  loaded.insert(cloud.points, cloud.normals);
  EXPECT_EQ(MapArchive::write(map), MapArchive::write(loaded));
}

}  // namespace
}  // namespace nvm
