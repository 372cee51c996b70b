// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "nvm/map/view_direction.hpp"
#include "nvm/map/voxel_map.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Normals = std::vector<Eigen::Vector3f>;

std::size_t total(const InsertStats& s) {
  return s.stored + s.settled + s.too_close + s.surface_full + s.no_normal + s.non_finite +
         s.out_of_range + s.map_full;
}

Eigen::Vector3f at_angle(double degrees) {
  const double angle = degrees * 3.14159265358979 / 180.0;
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F};
}

/// Sides of points inserted one by one into a single voxel, with normals at the given angles in the
/// xy plane.
std::vector<int> sides(const MapOptions& base, const std::vector<double>& degrees) {
  MapOptions options = base;
  options.min_point_distance = 0.0;
  VoxelMap map(options);
  std::vector<int> result;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const Eigen::Vector3d point(0.01 + 0.01 * static_cast<double>(i), 0.1, 0.1);
    map.insert(Points{point}, Normals{at_angle(degrees[i])});
    VoxelMap::QueryContext context;
    Neighbor nearest;
    EXPECT_EQ(map.nearest(point, {1, 0.001, Gate::kSurfaces}, &nearest, context), 1U);
    result.push_back(map.side(nearest.id));
  }
  return result;
}

TEST(ViewConsistency, PaperRuleFillsTheBackAndNeverResets) {
  EXPECT_THAT(sides({}, {0, 20, 180, 190, 10, 170}), ::testing::ElementsAre(0, 0, 1, 1, 0, 1));
  // Perpendicular to the front, and to the back: the paper says back all the same.
  EXPECT_THAT(sides({}, {0, 180, 95, 265}), ::testing::ElementsAre(0, 1, 1, 1));
}

TEST(ViewConsistency, SmallestAngleAndMoreSurfaces) {
  MapOptions options;
  options.surface_rule = SurfaceRule::kSmallestAngle;
  options.max_surface_angle = 1.0;
  options.max_surfaces = 3;
  EXPECT_THAT(sides(options, {0, 180, 90, 80, 190, 300}), ::testing::ElementsAre(0, 1, 2, 2, 1, 0));
  options.max_surfaces = 1;
  EXPECT_THAT(sides(options, {0, 180, 90}), ::testing::ElementsAre(0, 0, 0));
}

// Spec §3.4: 80 to 100 degrees must not change results materially.
TEST(ViewConsistency, ThresholdFrom80To100DegreesSeparatesThinWallsAlike) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(10000, 0.05, rng);
  std::vector<std::size_t> two_sided;
  for (const double degrees : {80.0, 90.0, 100.0}) {
    MapOptions options;
    options.max_surface_angle = degrees * 3.14159265358979 / 180.0;
    VoxelMap map(options);
    map.insert(wall.points, wall.normals);
    two_sided.push_back(map.stats().two_sided_voxels);
    map.for_each_point([](const MapPoint& point) {  // no surface mixes faces
      ASSERT_GT(point.normal.y() * static_cast<float>(point.position.y() - test::kWallY), -0.03F);
    });
  }
  EXPECT_EQ(two_sided[0], two_sided[1]);
  EXPECT_EQ(two_sided[1], two_sided[2]);
}

TEST(Insertion, FlippingAllNormalsFlipsTheMap) {
  std::mt19937_64 rng = test::rng();
  test::Cloud cloud = test::uniform_cloud(5000, 3.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap map;
  VoxelMap flipped;
  map.insert(cloud.points, cloud.normals);
  for (Eigen::Vector3f& normal : cloud.normals) {
    normal = -normal;
  }
  flipped.insert(cloud.points, cloud.normals);
  const std::vector<MapPoint> a = map.points();
  const std::vector<MapPoint> b = flipped.points();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].normal, -b[i].normal);
    EXPECT_EQ(a[i].side, b[i].side);
  }
}

TEST(Insertion, MovingByWholeVoxelsMovesTheMap) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.voxel_size = 0.25;
  const test::Cloud cloud = test::uniform_cloud(5000, 3.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap map(options);
  map.insert(cloud.points, cloud.normals);
  for (const Eigen::Vector3d& shift :
       {Eigen::Vector3d(0.25, -0.5, 100.0), Eigen::Vector3d(-1000.0, 2000.25, -0.75)}) {
    Pose T = Pose::Identity();
    T.translation() = shift;
    VoxelMap moved(options);
    moved.insert(cloud.points, cloud.normals, T);
    EXPECT_EQ(moved.size(), map.size());
    VoxelMap::QueryContext context;
    for (const MapPoint& point : map.points()) {
      Neighbor nearest;
      ASSERT_EQ(
          moved.nearest(point.position + shift, {1, 1e-3, Gate::kSurfaces}, &nearest, context), 1U);
      ASSERT_LT(nearest.sq_distance, 1e-8F);
    }
  }
}

TEST(Insertion, RotatesNormalsAndTransformsPoints) {
  std::mt19937_64 rng = test::rng();
  Pose T = Pose::Identity();
  T.linear() = so3_exp({0.3, -1.0, 2.0});
  T.translation() = Eigen::Vector3d(5.0, -7.0, 3.0);
  const test::Cloud cloud = test::uniform_cloud(500, 4.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap map;
  map.insert(cloud.points, cloud.normals, T);
  VoxelMap::QueryContext context;
  std::size_t checked = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    Neighbor nearest;
    if (map.nearest(T * cloud.points[i], {1, 1e-4, Gate::kSurfaces}, &nearest, context) == 1) {
      const Eigen::Vector3f expected = (T.linear() * cloud.normals[i].cast<double>()).cast<float>();
      EXPECT_GT(map.normal(nearest.id).dot(expected), 0.9999F);
      ++checked;
    }
  }
  EXPECT_GT(checked, 400U);
}

TEST(Insertion, KeepsCapacityAndDistancePerSide) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.points_per_surface = 11;
  options.min_point_distance = 0.04;
  VoxelMap map(options);
  const test::Cloud wall = test::thin_wall(30000, 0.03, rng);
  const InsertStats stats = map.insert(wall.points, wall.normals);
  EXPECT_EQ(total(stats), wall.points.size());
  EXPECT_GT(stats.surface_full, 0U);
  std::map<std::tuple<int, int, int, int>, Points> surfaces;
  map.for_each_point([&](const MapPoint& point) {
    const Eigen::Vector3i v = (point.position / options.voxel_size).array().floor().cast<int>();
    surfaces[{v.x(), v.y(), v.z(), point.side}].push_back(point.position);
  });
  for (const auto& [key, points] : surfaces) {
    EXPECT_LE(points.size(), 11U);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE((points[i] - points[j]).norm(), 0.04 - 5e-5);
      }
    }
  }
}

TEST(Insertion, SpacingReachesOverVoxelBordersButNotThroughTheWall) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.points_per_surface = 120;
  options.space_across_voxels = true;
  VoxelMap map(options);
  const test::Cloud wall = test::thin_wall(30000, 0.03, rng);
  const InsertStats stats = map.insert(wall.points, wall.normals);
  EXPECT_EQ(stats.stored + stats.too_close, wall.points.size());
  const std::vector<MapPoint> points = map.points();
  std::size_t close_through_the_wall = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (points[i].position - points[j].position).norm();
      const bool is_same_face = points[i].normal.dot(points[j].normal) > 0.0F;
      ASSERT_TRUE(!is_same_face || distance >= 0.1 - 1e-4) << distance;
      close_through_the_wall += !is_same_face && distance < 0.1 ? 1 : 0;
    }
  }
  EXPECT_GT(close_through_the_wall, points.size() / 4);
  for (std::size_t i = 0; i < wall.points.size(); i += 100) {  // and what is missing was too close
    bool is_covered = false;
    for (const MapPoint& point : points) {
      is_covered = is_covered || (point.normal.dot(wall.normals[i]) > 0.0F &&
                                  (point.position - wall.points[i]).norm() < 0.1 + 1e-4);
    }
    ASSERT_TRUE(is_covered) << wall.points[i].transpose();
  }
}

TEST(Insertion, CountsBadDataAndLosesNothingElse) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  const Points points{
      {0, 0, 0},
      {kNan, 0, 0},
      {0, HUGE_VAL, 0},
      {1e9, 0, 0},
      {1, 0, 0},
      {2, 0, 0},
      {3, 0, 0},
      {4, 0, 0}};
  const Normals normals{up, up, up, up, Eigen::Vector3f::Zero(), 2.0F * up, {kNanF, 0, 0}, up};
  VoxelMap map;
  const InsertStats stats = map.insert(points, normals);
  EXPECT_EQ(stats.stored, 2U);
  EXPECT_EQ(stats.non_finite, 2U);
  EXPECT_EQ(stats.out_of_range, 1U);
  EXPECT_EQ(stats.no_normal, 3U);
  EXPECT_EQ(map.size(), 2U);
  EXPECT_EQ(total(map.insert(Points{}, Normals{})), 0U);
}

TEST(Insertion, RefusesWhatTheCallerGotWrong) {
  VoxelMap map;
  EXPECT_THROW(map.insert(Points(2), Normals(1)), std::invalid_argument);
  Pose bad = Pose::Identity();
  bad.linear() *= 2.0;
  EXPECT_THROW(map.insert(Points(1), Normals(1), bad), std::invalid_argument);
  bad.linear().setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(map.insert_unsided(Points(1), bad), std::invalid_argument);
  EXPECT_TRUE(map.empty());
}

TEST(ViewDirections, TellTheFacesOfAWallApartWithoutNormals) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(20000, 0.05, rng);
  VoxelMap map;
  for (const double y : {3.0, -3.0}) {  // each face seen from its own side
    Points seen;
    for (const Eigen::Vector3d& point : wall.points) {
      if ((point.y() - test::kWallY) * y > 0.0) {
        seen.push_back(point);
      }
    }
    map.insert(seen, view_directions(seen, {0.0, y, 0.0}));
  }
  EXPECT_GT(map.stats().two_sided_voxels, 100U);
  map.for_each_point([](const MapPoint& point) {
    EXPECT_GT(point.normal.y() * static_cast<float>(point.position.y() - test::kWallY), 0.0F);
  });
  EXPECT_TRUE(view_direction(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 3)).isZero());
  EXPECT_TRUE(view_direction(Eigen::Vector3d(HUGE_VAL, 2, 3), Eigen::Vector3d(1, 2, 3)).isZero());
}

TEST(UnsidedInsertion, IsFoundByUngatedQueriesOnly) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(1000, 2.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap map;
  EXPECT_GT(map.insert_unsided(cloud.points).stored, 500U);
  EXPECT_EQ(map.stats().two_sided_voxels, 0U);
  VoxelMap::QueryContext context;
  std::array<Neighbor, 5> found;
  EXPECT_EQ(
      map.nearest(Eigen::Vector3d::Zero(), {5, 1.0, Gate::kSurfaces}, found.data(), context), 5U);
  EXPECT_EQ(
      map.nearest(
          Eigen::Vector3d::Zero(),
          Eigen::Vector3f::UnitX(),
          {5, 1.0, Gate::kSurfaces},
          found.data(),
          context),
      0U);
}

}  // namespace
}  // namespace nvm
