// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/crispness.hpp"

#include <gtest/gtest.h>

#include "eval/synthetic_wall.hpp"
#include "support/rng.hpp"

namespace nvm::eval {
namespace {

using test::make_wall;
using test::rng;
using test::sample_wall;

TEST(Crispness, OfAPlaneIsItsNoise) {
  auto random = rng();
  for (const double noise : {0.002, 0.01, 0.02}) {
    OrientedCloud cloud;
    test::sample_face(random, make_wall(0.1).faces[0], {3000, noise, 1.0}, cloud);
    EXPECT_NEAR(measure_crispness(cloud)->plane_thickness.value(), noise, 0.1 * noise);
  }
}

TEST(Crispness, DoesNotCountTheOtherFaceAsBlurWhereSidesAreKnown) {
  auto random = rng();
  OrientedCloud cloud = sample_wall(random, make_wall(0.05), {3000, 0.01, 1.0});
  EXPECT_NEAR(measure_crispness(cloud)->plane_thickness.value(), 0.01, 0.001);
  for (OrientedPoint& point : cloud.points) {
    point.normal.setZero();
  }
  EXPECT_NEAR(measure_crispness(cloud)->plane_thickness.value(), std::hypot(0.025, 0.01), 0.002);
}

TEST(Crispness, EntropyIsThatOfTheCovariance) {
  auto random = rng();
  std::normal_distribution<double> normal(0.0, 0.02);
  OrientedCloud ball;
  for (int i = 0; i < 1000; ++i) {
    ball.points.push_back(
        {{normal(random), normal(random), normal(random)}, Eigen::Vector3d::Zero()});
  }
  const auto crispness = measure_crispness(ball);
  EXPECT_NEAR(crispness->mean_map_entropy, 1.5 * std::log(17.079468445347132 * 0.02 * 0.02), 0.1);
  EXPECT_EQ(crispness->patches, 1000U);
  EXPECT_FALSE(crispness->plane_thickness.has_value());
}

TEST(Crispness, IsLowerForTheCrisperMap) {
  auto random = rng();
  const auto crisp = measure_crispness(sample_wall(random, make_wall(0.1), {3000, 0.005, 1.0}));
  const auto blurred = measure_crispness(sample_wall(random, make_wall(0.1), {3000, 0.02, 1.0}));
  EXPECT_LT(crisp->plane_thickness.value(), blurred->plane_thickness.value());
  EXPECT_LT(crisp->mean_map_entropy, blurred->mean_map_entropy);
}

TEST(Crispness, IsNothingWithoutSurfaces) {
  EXPECT_FALSE(measure_crispness(OrientedCloud()).has_value());
  OrientedCloud sparse;
  for (int i = 0; i < 20; ++i) {
    sparse.points.push_back({{1.0 * i, 0.0, 0.0}, {0.0, 0.0, 1.0}});
  }
  EXPECT_FALSE(measure_crispness(sparse).has_value());
}

}  // namespace
}  // namespace nvm::eval
