// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/ct_lio/ct_lio_map.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>

#include "adapters/reference_search.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using adapters::CtLioMap;
using Points = std::vector<Eigen::Vector3d>;

/// What ct-lio keeps, away from the planes through the origin: at most 20 points per voxel, no two
/// closer than a distance.
class Reference {
 public:
  void add(const Eigen::Vector3d& point) {
    Points& voxel = voxels_[key(point)];
    bool is_apart = voxel.size() < 20;
    for (const Eigen::Vector3d& other : voxel) {
      is_apart = is_apart && (other - point).norm() >= kMinDistance;
    }
    if (is_apart) {
      voxel.push_back(point);
    }
  }
  Points points() const {
    Points all;
    for (const auto& [index, voxel] : voxels_) {
      all.insert(all.end(), voxel.begin(), voxel.end());
    }
    return all;
  }
  static std::array<int, 3> key(const Eigen::Vector3d& point) {
    const Eigen::Vector3i index = (point / kVoxel).cast<int>();  // toward zero, as the host
    return {index.x(), index.y(), index.z()};
  }

  static constexpr double kVoxel = 0.2;
  static constexpr double kMinDistance = 0.05;

 private:
  std::map<std::array<int, 3>, Points> voxels_;
};

TEST(CtLioMap, TransparentKeepsAndFindsWhatCtLioDoes) {
  std::mt19937_64 rng = test::rng();
  CtLioMap map(CtLioMap::transparent(Reference::kVoxel, Reference::kMinDistance, 20));
  Reference reference;
  for (int scan = 0; scan < 3; ++scan) {
    const Points points = test::uniform_cloud(2000, 2.0, {5, 5, 5}, rng).points;
    map.add(points);
    for (const Eigen::Vector3d& point : points) {
      reference.add(point);
    }
  }
  const Points kept = reference.points();
  EXPECT_NEAR(static_cast<double>(map.size()), static_cast<double>(kept.size()), 5.0);
  for (const Eigen::Vector3d& query : test::uniform_cloud(100, 2.2, {5, 5, 5}, rng).points) {
    for (const int ring : {1, 2}) {
      const std::vector<double> expected =
          test::nearest_distances(kept, query, 20, [&](const Eigen::Vector3d& p) {
            const auto a = Reference::key(p);
            const auto b = Reference::key(query);
            return std::abs(a[0] - b[0]) <= ring && std::abs(a[1] - b[1]) <= ring &&
                   std::abs(a[2] - b[2]) <= ring;
          });
      const CtLioMap::Points found = map.search(query, Eigen::Vector3d::Zero(), 20, ring);
      ASSERT_NEAR(static_cast<double>(found.size()), static_cast<double>(expected.size()), 1.0);
      if (found.size() == expected.size()) {
        EXPECT_NEAR((found.back() - query).norm(), expected.back(), 0.01);
        EXPECT_NEAR((found.front() - query).norm(), expected.front(), test::kLattice);
      }
    }
  }
}

TEST(CtLioMap, NormalsKeepTheSidesOfAWallApart) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(4000, 0.05, rng);
  CtLioMap map;
  EXPECT_EQ(map.size(), 0U);
  EXPECT_TRUE(map.search({0, 0, 0}, Eigen::Vector3d::UnitZ(), 20).empty());
  map.add(wall.points, wall.normals);
  for (std::size_t i = 0; i < wall.points.size(); i += 7) {
    for (const int ring : {1, 2}) {
      const CtLioMap::Points found =
          map.search(wall.points[i], wall.normals[i].cast<double>(), 20, ring);
      EXPECT_GE(found.size(), 5U);  // fewer at the edges of the wall
      for (const Eigen::Vector3d& point : found) {
        EXPECT_EQ(point.y() > test::kWallY, wall.normals[i].y() > 0.0F);
      }
    }
  }
}

TEST(CtLioMap, PointsWithoutNormalsFollowThePolicy) {
  const Points points{{0.1, 0.1, 0.1}, {0.5, 0.5, 0.5}};
  const std::vector<Eigen::Vector3f> normals{{0, 0, 1}, {0, 0, 0}};
  CtLioMap map;
  EXPECT_EQ(map.add(points, normals).stored, 2U);
  for (const int ring : {1, 2}) {
    EXPECT_EQ(map.search({0.3, 0.3, 0.3}, Eigen::Vector3d::Zero(), 20, ring).size(), 2U);
  }
  adapters::HostOptions options = CtLioMap::defaults();
  options.normals.missing = adapters::MissingNormal::kDrop;
  map.configure(options);
  EXPECT_EQ(map.add(points, normals).no_normal, 1U);
  EXPECT_EQ(map.size(), 1U);
  for (const int ring : {1, 2}) {
    EXPECT_TRUE(map.search(points[0], Eigen::Vector3d::Zero(), 20, ring).empty());
  }
}

TEST(CtLioMap, AViewPointStandsInForNormals) {
  adapters::HostOptions options = CtLioMap::defaults();
  options.normals.missing = adapters::MissingNormal::kViewDirection;
  CtLioMap map(options);
  map.set_view_point({0, 3, 0});
  map.add(Points{{0.1, 0.2, 0.1}});
  EXPECT_EQ(map.search({0.1, 0.15, 0.1}, 20).size(), 1U);
  map.set_view_point({0, -3, 0});
  EXPECT_EQ(map.search({0.1, 0.15, 0.1}, 20).size(), 0U);
}

TEST(CtLioMap, EvictsByRadius) {
  CtLioMap map;
  EXPECT_EQ(map.evict_beyond({0, 0, 0}, 1.0), 0U);
  const std::vector<Eigen::Vector3f> normals(2, Eigen::Vector3f::UnitX());
  map.add(Points{{0.1, 0.1, 0.1}, {30, 0.1, 0.1}}, normals);
  EXPECT_EQ(map.evict_beyond({0, 0, 0}, 15.0), 1U);
  EXPECT_THAT(map.density_warning(0.2), testing::HasSubstr("20 neighbours"));
}

}  // namespace
}  // namespace nvm
