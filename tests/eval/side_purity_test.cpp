// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/side_purity.hpp"

#include <gtest/gtest.h>

#include "eval/synthetic_wall.hpp"
#include "eval/walls/wall_points.hpp"
#include "support/rng.hpp"

namespace nvm::eval {
namespace {

using test::make_wall;
using test::rng;
using test::sample_wall;

double purity(const OrientedCloud& cloud, const WallPiece& wall) {
  return count_sides(wall_points(cloud, wall, WallPointOptions()), wall).purity().value();
}

/// Turns the normal of each point with this probability.
void plant_wrong_sides(std::mt19937_64& random, double share, OrientedCloud& cloud) {
  std::bernoulli_distribution is_wrong(share);
  for (OrientedPoint& sample : cloud.points) {
    sample.normal *= is_wrong(random) ? -1.0 : 1.0;
  }
}

class PurityOfThickness : public ::testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(SidePurity, PurityOfThickness, ::testing::Values(0.15, 0.10, 0.05, 0.03));

TEST_P(PurityOfThickness, IsWholeWhenNoPointIsWrongHoweverNoisy) {
  auto random = rng();
  const auto wall = make_wall(GetParam());
  const OrientedCloud cloud = sample_wall(random, wall, {40000, 0.01, 1.0});
  EXPECT_GE(purity(cloud, wall), 0.999);
}

TEST_P(PurityOfThickness, FindsTheShareOfPlantedWrongPoints) {
  auto random = rng();
  const auto wall = make_wall(GetParam());
  for (const double share : {0.005, 0.02, 0.05}) {
    OrientedCloud cloud = sample_wall(random, wall, {40000, 0.01, 1.0});
    plant_wrong_sides(random, share, cloud);
    EXPECT_NEAR(1.0 - purity(cloud, wall), share, 0.05 * share + 0.0015) << share;
  }
}

TEST_P(PurityOfThickness, IsAHalfWhenNormalsAreTossed) {
  auto random = rng();
  const auto wall = make_wall(GetParam());
  OrientedCloud cloud = sample_wall(random, wall, {20000, 0.01, 1.0});
  plant_wrong_sides(random, 0.5, cloud);
  EXPECT_NEAR(purity(cloud, wall), 0.5, 0.03);
}

TEST_P(PurityOfThickness, DoesNotSufferWhenTheWholeWallIsOffByCentimetres) {
  auto random = rng();
  const auto wall = make_wall(GetParam());
  Pose T = Pose::Identity();
  T.translation() = Eigen::Vector3d(0.03, 0.02, 0.0);
  const OrientedCloud cloud = transformed(sample_wall(random, wall, {40000, 0.01, 1.0}), T);
  EXPECT_GE(purity(cloud, wall), 0.999);
}

TEST(SidePurity, IsUnknownWithoutPointsOnBothFaces) {
  auto random = rng();
  const auto wall = make_wall(0.1);
  OrientedCloud cloud;
  test::sample_face(random, wall.faces[0], {}, cloud);
  const auto points = wall_points(cloud, wall, WallPointOptions());
  EXPECT_FALSE(count_sides(points, wall).purity().has_value());
}

}  // namespace
}  // namespace nvm::eval
