// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/rng.hpp"
#include "survey/surface_sampler.hpp"
#include "survey/survey.hpp"

// What buildings have besides plain walls; docs/walls.md says of each what can be decided.
namespace nvm::survey {
namespace {

using test::SurfaceSampler;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const Eigen::Vector3d kUp(0, 0, 2.5);  // of the walls below [m]

std::vector<const Wall*> of_kind(const Survey& survey, WallKind kind) {
  std::vector<const Wall*> result;
  for (const Wall& wall : survey.walls) {
    if (wall.kind == kind) {
      result.push_back(&wall);
    }
  }
  return result;
}

// A pane of 2 m between two pieces of wall, which returns a pulse in forty.
TEST(HardCases, GlassIsAGapAndTheWallBesideItAsThickAsItIs) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {3, 0}, 0.1, 2.5);
  sampler.add_wall({5, 0}, {8, 0}, 0.1, 2.5);
  SurfaceSampler glass(random);
  glass.spacing = 0.6;
  glass.add_wall({3, 0}, {5, 0}, 0.012, 2.5);
  io::MapCloud& cloud = sampler.cloud;
  cloud.positions.insert(
      cloud.positions.end(), glass.cloud.positions.begin(), glass.cloud.positions.end());
  cloud.normals.insert(cloud.normals.end(), glass.cloud.normals.begin(), glass.cloud.normals.end());
  const Survey survey = survey_walls(cloud, {});
  EXPECT_THAT(survey.bodies, IsEmpty());
  ASSERT_FALSE(survey.walls.empty());
  double area = 0.0;
  for (const Wall& wall : survey.walls) {
    EXPECT_NEAR(wall.thickness, 0.1, 4.0 * wall.thickness_std);
    area += wall.area;
  }
  EXPECT_NEAR(area, 6.0 * 2.5, 0.7);  // and none of the pane
}

// The leaf is flush with the front of its wall; behind, it is set back.
TEST(HardCases, AClosedDoorIsADoorWithinItsWall) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  const Eigen::Vector3d x(1, 0, 0);
  sampler.add({0, -0.05, 0}, 5.0 * x, kUp);  // the front, leaf included
  sampler.add({5, 0.05, 0}, -2.1 * x, kUp);
  sampler.add({2, 0.05, 0}, -2.0 * x, kUp);
  sampler.add({2.9, 0.05, 2.0}, -0.9 * x, {0, 0, 0.5});
  sampler.add({2.9, -0.01, 0}, -0.9 * x, {0, 0, 2.0});
  const Survey survey = survey_walls(sampler.cloud, {});
  const auto doors = of_kind(survey, WallKind::kDoor);
  const auto walls = of_kind(survey, WallKind::kWall);
  ASSERT_THAT(doors, SizeIs(1));
  ASSERT_THAT(walls, SizeIs(1));
  EXPECT_NEAR(doors[0]->thickness, 0.04, 0.001);
  EXPECT_NEAR(doors[0]->length, 0.9, 0.15);
  EXPECT_NEAR(walls[0]->thickness, 0.1, 0.001);
  EXPECT_NEAR(walls[0]->length, 5.0, 0.15);
}

// A wall as low, whose other side is as low, is a partition.
TEST(HardCases, ADoorLeafOfWhichOneSideIsSeenByHalfIsADoor) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add({0, 0, 0}, {0.9, 0, 0}, {0, 0, 2.0});
  sampler.add({0.9, 0.04, 0.9}, {-0.9, 0, 0}, {0, 0, 1.1});
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(of_kind(survey, WallKind::kDoor), SizeIs(1));
  EXPECT_NEAR(survey.walls[0].height, 1.1, 0.15);
}

// Of the wall that a partition abuts on, both faces are near its end.
TEST(HardCases, APartitionEndsAtTheFaceOfTheWallThatItAbutsOn) {
  auto random = test::rng();
  for (const double thickness : {0.06, 0.08, 0.1, 0.12}) {
    SurfaceSampler sampler(random);
    sampler.add_wall({-3, -0.5 * thickness}, {3, -0.5 * thickness}, thickness, 2.5);
    sampler.add_wall({0.03, 0}, {0.03, 4}, 0.1, 2.5);
    const Survey survey = survey_walls(sampler.cloud, {});
    ASSERT_THAT(survey.walls, SizeIs(2));
    const bool is_first = std::abs(survey.walls[0].faces[0].plane.normal.x()) > 0.5;
    for (const SurveyFace& face : survey.walls[is_first ? 0 : 1].faces) {
      double end = HUGE_VAL;
      for (const Eigen::Vector3d& p : face.polygon) {
        end = std::min(end, p.y());
      }
      EXPECT_NEAR(end, 0.0, 0.005) << thickness;
    }
  }
}

TEST(HardCases, AWallUnderASlopingCeilingEndsAtTheCeiling) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {4, 0}, 0.1, 3.5);
  const auto is_above = [](const Eigen::Vector3d& p) { return p.z() > 2.0 + 0.375 * p.x(); };
  SurfaceSampler cut(random);
  for (std::size_t i = 0; i < sampler.cloud.positions.size(); ++i) {
    if (!is_above(sampler.cloud.positions[i])) {
      cut.cloud.positions.push_back(sampler.cloud.positions[i]);
      cut.cloud.normals.push_back(sampler.cloud.normals[i]);
    }
  }
  for (const double y : {-2.0, 0.05}) {  // the ceiling, from below
    cut.add({0, y, 2}, {0, 1.95, 0}, {4, 0, 1.5});
  }
  cut.add({0, -2, 0}, {4, 0, 0}, {0, 4, 0});
  const Survey survey = survey_walls(cut.cloud, {});
  ASSERT_THAT(survey.walls, SizeIs(1));
  EXPECT_NEAR(survey.walls[0].thickness, 0.1, 0.001);
  for (const SurveyFace& face : survey.walls[0].faces) {
    double left = 0.0;
    double right = 0.0;
    for (const Eigen::Vector3d& p : face.polygon) {
      EXPECT_LT(p.z(), 2.0 + 0.375 * p.x() + 0.1) << p.transpose();
      (p.x() < 2.0 ? left : right) = std::max(p.x() < 2.0 ? left : right, p.z());
    }
    EXPECT_NEAR(right, 3.5, 0.1);
    EXPECT_LT(left, 2.9);
  }
  EXPECT_THAT(survey.faces, SizeIs(::testing::Ge(2)));
}

TEST(HardCases, ACupboardAsHighAsItsWallCannotBeToldFromAThickerWall) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add({4, 0.1, 0}, {-4, 0, 0}, kUp);
  sampler.add({0, 0, 0}, {1, 0, 0}, kUp);
  sampler.add({2.5, 0, 0}, {1.5, 0, 0}, kUp);
  sampler.add({1, -0.3, 0}, {1.5, 0, 0}, kUp);
  const Survey survey = survey_walls(sampler.cloud, {});
  const auto walls = of_kind(survey, WallKind::kWall);
  ASSERT_THAT(walls, SizeIs(2));
  EXPECT_NEAR(walls[0]->thickness, 0.1, 0.001);
  EXPECT_NEAR(walls[1]->thickness, 0.4, 0.002);
}

}  // namespace
}  // namespace nvm::survey
