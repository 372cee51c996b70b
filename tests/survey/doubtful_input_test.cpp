// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <cmath>

#include "support/rng.hpp"
#include "survey/surface_sampler.hpp"
#include "survey/survey.hpp"

// What a list is worth nothing with, and what a map shows of it.
namespace nvm::survey {
namespace {

using test::SurfaceSampler;

void turn_normals(io::MapCloud& cloud) {
  for (Eigen::Vector3f& normal : cloud.normals) {
    normal = -normal;
  }
}

TEST(DoubtfulInput, NormalsThatPointIntoTheWallsAreNoticed) {
  auto random = test::rng();
  SurfaceSampler wall(random);
  wall.add_wall({0, 0}, {4, 0}, 0.1, 2.5);
  EXPECT_FALSE(survey_walls(wall.cloud, {}).is_inside_out);
  turn_normals(wall.cloud);
  EXPECT_TRUE(survey_walls(wall.cloud, {}).is_inside_out);
  for (const bool has_wall : {true, false}) {
    SurfaceSampler room(random);
    room.add({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
    room.add({0, 0, 2.5}, {0, 3, 0}, {4, 0, 0});
    if (has_wall) {
      room.add_wall({1, 1}, {3, 1}, 0.1, 2.5);
    }
    EXPECT_FALSE(survey_walls(room.cloud, {}).is_inside_out);
    turn_normals(room.cloud);
    EXPECT_TRUE(survey_walls(room.cloud, {}).is_inside_out);
  }
}

// A ceiling alone looks down as the underside of a floor would; two wardrobes side by side in a
// room look at each other.
TEST(DoubtfulInput, CeilingsAndNarrowGapsAreNotInsideOut) {
  auto random = test::rng();
  SurfaceSampler ceiling(random);
  ceiling.add({0, 0, 2.5}, {0, 3, 0}, {4, 0, 0});
  ceiling.add({0, 0, 0}, {4, 0, 0}, {0, 0, 2.5});
  EXPECT_FALSE(survey_walls(ceiling.cloud, {}).is_inside_out);
  SurfaceSampler gap(random);
  gap.add({0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  gap.add({1, 1, 0}, {0, 0, 2}, {0, 1, 0});
  gap.add({0.5, 1, 0}, {0, 1, 0}, {0, 0, 2});
  EXPECT_FALSE(survey_walls(gap.cloud, {}).is_inside_out);
}

TEST(DoubtfulInput, CoordinatesThatWereRoundedAreNoticed) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {4, 0}, 0.1, 2.5);
  EXPECT_EQ(survey_walls(sampler.cloud, {}).rounding, 0.0);
  for (const double away : {0.0, 480000.0}) {
    io::MapCloud rounded = sampler.cloud;
    for (Eigen::Vector3d& p : rounded.positions) {
      p.x() += away;
      for (double& coordinate : p) {
        const auto single = static_cast<float>(coordinate);
        coordinate = static_cast<double>(single);
      }
    }
    const double rounding = survey_walls(rounded, {}).rounding;
    EXPECT_EQ(rounding, away > 0.0 ? 1.0 / 32.0 : std::pow(2.0, -22));
  }
}

}  // namespace
}  // namespace nvm::survey
