// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/kiss_icp/kiss_map.hpp"

#include <gtest/gtest.h>
#include <tbb/blocked_range.h>
#include <tbb/concurrent_vector.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "adapters/reference_search.hpp"
#include "nvm/geometry/pose.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"
#include "support/sanitizers.hpp"

namespace kiss_icp {
namespace {

namespace test = nvm::test;
using SE3d = nvm::Pose;
using Points = std::vector<Eigen::Vector3d>;

struct VoxelHashMap : nvm::adapters::KissMap<SE3d> {
  using KissMap::KissMap;
};

/// The call of the registration to the map, from TBB as there.
tbb::concurrent_vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> associate(
    const Points& points, const VoxelHashMap& voxel_map, double max_distance) {
  tbb::concurrent_vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> correspondences;
  tbb::parallel_for(
      tbb::blocked_range<Points::const_iterator>{points.cbegin(), points.cend()},
      [&](const auto& range) {
        std::for_each(range.begin(), range.end(), [&](const auto& point) {
          const auto& [closest_neighbor, distance] = voxel_map.GetClosestNeighbor(point);
          if (distance < max_distance) {
            correspondences.emplace_back(point, closest_neighbor);
          }
        });
      });
  return correspondences;
}

/// What KISS-ICP keeps: voxels of at most `cap` points no two closer than size / sqrt(cap).
class Reference {
 public:
  Reference(double size, std::size_t cap) : size_(size), cap_(cap) {}

  void add(const Eigen::Vector3d& point) {
    Points& voxel = voxels_[key(point)];
    const double apart = size_ / std::sqrt(static_cast<double>(cap_));
    if (voxel.size() < cap_ && std::none_of(voxel.begin(), voxel.end(), [&](const auto& other) {
          return (other - point).norm() < apart;
        })) {
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
  std::array<double, 3> key(const Eigen::Vector3d& point) const {
    return {
        std::floor(point.x() / size_),
        std::floor(point.y() / size_),
        std::floor(point.z() / size_)};
  }

 private:
  double size_;
  std::size_t cap_;
  std::map<std::array<double, 3>, Points> voxels_;
};

TEST(KissMap, TransparentKeepsAndFindsWhatKissIcpDoes) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("oneTBB");
  std::mt19937_64 rng = test::rng();
  VoxelHashMap map(1.0, 100.0, 20);
  map.make_transparent();
  Reference reference(1.0, 20);
  SE3d pose = SE3d::Identity();
  for (int scan = 0; scan < 3; ++scan) {
    pose.translation().x() = 0.4 * scan;
    const Points points = test::uniform_cloud(2000, 5.0, {0, 0, 0}, rng).points;
    map.Update(points, pose);
    for (const Eigen::Vector3d& point : points) {
      reference.add(pose * point);
    }
  }
  const Points kept = reference.points();
  EXPECT_NEAR(static_cast<double>(map.Pointcloud().size()), static_cast<double>(kept.size()), 3.0)
      << "distances within the lattice of min_point_distance may fall either way";
  for (const auto& [query, found] :
       associate(test::uniform_cloud(300, 6.0, {0, 0, 0}, rng).points, map, 3.0)) {
    const auto near = [&, q = query](const Eigen::Vector3d& p) {
      const auto a = reference.key(p);
      const auto b = reference.key(q);
      return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
    };
    const std::vector<double> expected = test::nearest_distances(kept, query, 1, near);
    ASSERT_EQ(expected.size(), 1U);
    EXPECT_NEAR((found - query).norm(), expected[0], 2 * test::kLattice);
  }
}

TEST(KissMap, TheOriginsOfScansKeepTheSidesOfAWallApart) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("oneTBB");
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(4000, 0.05, rng);
  Points front, back;
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    (wall.normals[i].y() > 0.0F ? front : back).push_back(wall.points[i]);
  }
  VoxelHashMap map(0.5, 100.0, 20);
  map.Update(front, Eigen::Vector3d(0.0, 4.0, 0.0));
  map.Update(back, Eigen::Vector3d(0.0, -4.0, 0.0));
  const auto matches = associate(back, map, 1.0);
  EXPECT_EQ(matches.size(), back.size());
  for (const auto& [query, found] : matches) {
    EXPECT_LT(found.y(), test::kWallY);
  }
  for (const Eigen::Vector3d& query : front) {
    const auto [seen, near] = map.GetClosestNeighborFrom(query, {0.0, 4.0, 0.0});
    EXPECT_GT(seen.y(), test::kWallY);
    const auto [agreeing, also_near] = map.GetClosestNeighbor(query, Eigen::Vector3d::UnitY());
    EXPECT_GT(agreeing.y(), test::kWallY);
  }
}

// The Python bindings take the addresses of members.
TEST(KissMap, HasOneMemberOfEachNameThatTheBindingsTakeTheAddressOf) {
  VoxelHashMap map(1.0, 10.0, 20);
  const auto add = &VoxelHashMap::AddPoints;
  (map.*add)({{0.5, 0.5, 0.5}});
  bool (VoxelHashMap::*const empty)() const = &VoxelHashMap::Empty;
  EXPECT_FALSE((map.*empty)());
  const auto point_cloud = &VoxelHashMap::Pointcloud;
  EXPECT_EQ((map.*point_cloud)().size(), 1U);
  const auto remove = &VoxelHashMap::RemovePointsFarFromLocation;
  (map.*remove)({100.0, 0.0, 0.0});
  EXPECT_TRUE(map.Empty());
  const auto clear = &VoxelHashMap::Clear;
  (map.*clear)();
}

TEST(KissMap, NormalsOfPointsAreTakenFromWhereverTheyCome) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(2000, 0.05, rng);
  VoxelHashMap map(0.5, 100.0, 20);
  map.AddPointsWithNormals(wall.points, wall.normals);
  for (std::size_t i = 0; i < wall.points.size(); i += 7) {
    const auto [near, distance] =
        map.GetClosestNeighbor(wall.points[i], wall.normals[i].cast<double>());
    EXPECT_EQ(near.y() > test::kWallY, wall.points[i].y() > test::kWallY);
    EXPECT_LT(distance, 0.5);
  }
  nvm::adapters::HostOptions options = map.options();
  options.normals.query = nvm::adapters::NormalSource::kNone;
  map.configure(options);
  EXPECT_TRUE(map.Empty());
  map.AddPointsWithNormals(wall.points, wall.normals);
  EXPECT_LT(std::get<1>(map.GetClosestNeighbor(wall.points[0])), 0.01);
}

TEST(KissMap, EvictsClearsAndAnswersWhenEmptyAsTheHostDoes) {
  VoxelHashMap map(1.0, 10.0, 20);
  EXPECT_TRUE(map.Empty());
  EXPECT_EQ(
      std::get<1>(map.GetClosestNeighbor(Eigen::Vector3d::Zero())),
      std::numeric_limits<double>::max());
  map.AddPoints({{0.5, 0.5, 0.5}, {20.5, 0.5, 0.5}});
  EXPECT_EQ(map.Pointcloud().size(), 2U);
  map.RemovePointsFarFromLocation({0, 0, 0});
  EXPECT_EQ(map.Pointcloud().size(), 1U);
  map.Clear();
  EXPECT_TRUE(map.Empty());
  EXPECT_THROW(VoxelHashMap(1.0, 10.0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace kiss_icp
