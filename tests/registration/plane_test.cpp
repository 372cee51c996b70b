// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/registration/plane.hpp"

#include <gmock/gmock.h>

#include <random>
#include <vector>

#include "nvm/geometry/pose.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

std::vector<Neighbor> as_neighbors(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Neighbor> neighbors;
  for (const Eigen::Vector3d& point : points) {
    neighbors.push_back({point, 0.0F, 0});
  }
  return neighbors;
}

TEST(Plane, FindsTheNormalOfRandomPlanesFarFromTheOrigin) {
  auto rng = test::rng();
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int seed = 0; seed < 200; ++seed) {
    const Eigen::Matrix3d R =
        so3_exp(3.0 * Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng)));
    const Eigen::Vector3d center = 1e5 * Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng));
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 10; ++i) {
      points.push_back(center + R * Eigen::Vector3d(0.3 * uniform(rng), 0.3 * uniform(rng), 0.0));
    }
    const auto neighbors = as_neighbors(points);
    const auto plane = fit_plane(neighbors.data(), neighbors.size());
    ASSERT_TRUE(plane);
    EXPECT_NEAR(std::abs(plane->normal.dot(R.col(2))), 1.0, 1e-9);
    EXPECT_NEAR(R.col(2).dot(plane->centroid - center), 0.0, 1e-9);
    EXPECT_GE(plane->planarity, 0.0);
    EXPECT_LE(plane->planarity, 1.0);
  }
}

TEST(Plane, PlanarityIsThatOfTheDefinition) {
  // Variances 4/3, 1/3 and 1/12 along the axes: sigma2 / sigma1 = 1/2, sigma3 / sigma1 = 1/4.
  const auto neighbors = as_neighbors(
      {{2.0, 0.0, 0.0},
       {-2.0, 0.0, 0.0},
       {0.0, 1.0, 0.0},
       {0.0, -1.0, 0.0},
       {0.0, 0.0, 0.5},
       {0.0, 0.0, -0.5}});
  const auto plane = fit_plane(neighbors.data(), neighbors.size());
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->planarity, 0.25, 1e-12);
  EXPECT_NEAR(std::abs(plane->normal.z()), 1.0, 1e-12);
}

TEST(Plane, NoneThroughLinesPointsAndTooFew) {
  const auto line = as_neighbors({{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {2.0, 2.0, 0.0}});
  EXPECT_FALSE(fit_plane(line.data(), line.size()));
  const auto point = as_neighbors({{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}});
  EXPECT_FALSE(fit_plane(point.data(), point.size()));
  EXPECT_FALSE(fit_plane(line.data(), 2));
  EXPECT_FALSE(fit_plane(nullptr, 0));
}

}  // namespace
}  // namespace nvm
