// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "adapters/reference_search.hpp"
#include "adapters/small_gicp/plane_factor.hpp"
#include "nvm/geometry/pose.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

// The source cloud of the tests, through small_gicp's traits.
template <>
struct small_gicp::traits::Traits<nvm::test::Cloud> {
  static std::size_t size(const nvm::test::Cloud& cloud) { return cloud.points.size(); }
  static Eigen::Vector4d point(const nvm::test::Cloud& cloud, std::size_t i) {
    return cloud.points[i].homogeneous();
  }
  static Eigen::Vector4d normal(const nvm::test::Cloud& cloud, std::size_t i) {
    Eigen::Vector4d normal = Eigen::Vector4d::Zero();
    normal.head<3>() = cloud.normals[i].cast<double>();
    return normal;
  }
};

namespace nvm {
namespace {

namespace traits = small_gicp::traits;
using adapters::NormalConsistentPlaneFactor;
using adapters::SourceNormal;

struct DistanceRejector {
  double max_dist_sq = 1.0;
  template <class Target, class Source>
  bool operator()(
      const Target&,
      const Source&,
      const Eigen::Isometry3d&,
      std::size_t,
      std::size_t,
      double sq_dist) const {
    return sq_dist > max_dist_sq;
  }
};

/// Three faces of a room's corner and one thin wall, with normals.
test::Cloud corner_and_wall(std::mt19937_64& rng) {
  test::Cloud cloud = test::thin_wall(4000, 0.05, rng);
  std::uniform_real_distribution<double> u(-2.0, 2.0);
  for (int i = 0; i < 4000; ++i) {
    const int axis = i % 2 == 0 ? 0 : 2;
    Eigen::Vector3d point(u(rng), u(rng), u(rng));
    point[axis] = -3.0;
    cloud.points.push_back(point);
    cloud.normals.emplace_back(Eigen::Vector3f::Unit(axis));
  }
  return cloud;
}

VoxelMap dense_map(const test::Cloud& cloud) {
  MapOptions options;
  options.min_point_distance = 0.0;
  VoxelMap map(options);
  map.insert(cloud.points, cloud.normals);
  return map;
}

TEST(SmallGicp, TraitsGiveTheNearestPoints) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(2000, 3.0, {0, 0, 0}, rng);
  const VoxelMap map = dense_map(cloud);
  ASSERT_EQ(traits::size(map), cloud.points.size());
  for (const Eigen::Vector3d& query : test::uniform_cloud(100, 2.0, {0, 0, 0}, rng).points) {
    const auto expected = test::nearest_distances(
        cloud.points, query, 5, [](const Eigen::Vector3d&) { return true; });
    std::array<std::size_t, 5> ids;
    std::array<double, 5> sq_distances;
    ASSERT_EQ(traits::knn_search(map, query.homogeneous(), 5, ids.data(), sq_distances.data()), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(std::sqrt(sq_distances[i]), expected[i], test::kLattice);
      const Eigen::Vector4d point = traits::point(map, ids[i]);
      EXPECT_EQ(point.w(), 1.0);
      EXPECT_NEAR((point.head<3>() - query).norm(), expected[i], test::kLattice);
    }
    EXPECT_EQ(traits::normal(map, ids[0]).w(), 0.0);
    std::size_t nearest = 0;
    double sq_distance = 0.0;
    EXPECT_EQ(
        traits::nearest_neighbor_search(map, query.homogeneous(), &nearest, &sq_distance), 1U);
    EXPECT_EQ(nearest, ids[0]);
  }
}

/// Gauss-Newton as small_gicp's optimiser does it.
Eigen::Isometry3d align(
    const VoxelMap& map,
    const test::Cloud& source,
    const NormalConsistentPlaneFactor::Setting& setting,
    Eigen::Isometry3d T) {
  std::vector<NormalConsistentPlaneFactor> factors(
      traits::size(source), NormalConsistentPlaneFactor(setting));
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::Matrix<double, 6, 6> sum_H = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 1> sum_b = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < factors.size(); ++i) {
      Eigen::Matrix<double, 6, 6> H;
      Eigen::Matrix<double, 6, 1> b;
      double e = 0.0;
      if (factors[i].linearize(map, source, map, T, i, DistanceRejector{0.25}, &H, &b, &e)) {
        EXPECT_NEAR(e, factors[i].error(map, source, T), 1e-9);
        sum_H += H;
        sum_b += b;
      }
    }
    const Eigen::Matrix<double, 6, 1> step = sum_H.ldlt().solve(-sum_b);
    Eigen::Isometry3d change = Eigen::Isometry3d::Identity();
    change.linear() = so3_exp(step.head<3>());
    change.translation() = step.tail<3>();
    T = T * change;
  }
  return T;
}

TEST(SmallGicp, TheFactorAlignsWhereBothSidesOfAWallWouldMatch) {
  std::mt19937_64 rng = test::rng();
  const VoxelMap map = dense_map(corner_and_wall(rng));
  test::Cloud source = corner_and_wall(rng);
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.translation() = Eigen::Vector3d(0.05, 0.04, -0.05);
  start.linear() = so3_exp(Eigen::Vector3d(0.005, -0.01, 0.01));
  const Eigen::Isometry3d gated = align(map, source, {SourceNormal::kPoint}, start);
  EXPECT_LT(gated.translation().norm(), 0.004);
  EXPECT_LT((gated.linear() - Eigen::Matrix3d::Identity()).norm(), 0.004);
}

TEST(SmallGicp, MatchesAreOnTheSideOfTheSource) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(3000, 0.05, rng);
  const VoxelMap map = dense_map(wall);
  using MapTraits = traits::Traits<VoxelMap>;
  std::size_t discarded = 0;
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    const Eigen::Vector3d normal = wall.normals[i].cast<double>();
    const Eigen::Vector3d behind = wall.points[i] - 0.04 * normal;  // nearer to the other face
    std::size_t found = 0;
    double sq_distance = 0.0;
    ASSERT_EQ(
        MapTraits::gated_nearest_neighbor_search(
            map, behind.homogeneous(), normal, &found, &sq_distance),
        1U);
    EXPECT_GT(traits::normal(map, found).head<3>().dot(normal), 0.0);
    test::Cloud shifted{"", {behind}, {wall.normals[i]}};
    ASSERT_EQ(
        MapTraits::nearest_neighbor_search(map, behind.homogeneous(), &found, &sq_distance), 1U);
    discarded += adapters::NormalRejector{}(
                     map, shifted, Eigen::Isometry3d::Identity(), found, 0, sq_distance)
                     ? 1U
                     : 0U;
  }
  EXPECT_GT(discarded, wall.points.size() / 10);
}

TEST(SmallGicp, PointsWithoutANormalMakeNoFactor) {
  const VoxelMap map = dense_map({"", {{0.1, 0.1, 0.1}}, {{0, 0, 1}}});
  const test::Cloud source{"", {{0.1, 0.1, 0.12}}, {{0, 0, 0}}};
  Eigen::Matrix<double, 6, 6> H;
  Eigen::Matrix<double, 6, 1> b;
  double e = 0.0;
  const auto makes_factor = [&](SourceNormal from, const test::Cloud& cloud) {
    NormalConsistentPlaneFactor factor({from});
    const bool made = factor.linearize(
        map, cloud, map, Eigen::Isometry3d::Identity(), 0, DistanceRejector{}, &H, &b, &e);
    EXPECT_EQ(made, factor.inlier());
    return made;
  };
  EXPECT_FALSE(makes_factor(SourceNormal::kPoint, source));
  EXPECT_TRUE(makes_factor(SourceNormal::kNone, source));
  EXPECT_NEAR(e, 0.5 * 0.02 * 0.02, 1e-5);
  EXPECT_FALSE(makes_factor(SourceNormal::kViewDirection, source)) << "seen from below";
  const test::Cloud nan{"", {{std::nan(""), 0, 0}}, {{0, 0, 1}}};
  EXPECT_FALSE(makes_factor(SourceNormal::kPoint, nan));
}

}  // namespace
}  // namespace nvm
