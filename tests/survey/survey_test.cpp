// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "eval/walls/thickness.hpp"
#include "eval/walls/wall_points.hpp"
#include "support/rng.hpp"
#include "survey/surface_sampler.hpp"
#include "survey/survey.hpp"

namespace nvm::survey {
namespace {

using test::SurfaceSampler;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

std::vector<WallKind> kinds(const std::vector<Wall>& walls) {
  std::vector<WallKind> result;
  for (const Wall& wall : walls) {
    result.push_back(wall.kind);
  }
  return result;
}

/// `map` turned and moved by `T`.
io::MapCloud moved(io::MapCloud map, const Eigen::Isometry3d& T) {
  for (std::size_t i = 0; i < map.positions.size(); ++i) {
    map.positions[i] = T * map.positions[i];
    map.normals[i] = T.linear().cast<float>() * map.normals[i];
  }
  return map;
}

TEST(Survey, AWallIsAsThickAndLongAsItIs) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({1, 2}, {5, 2}, 0.05, 2.5);
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(survey.walls, SizeIs(1));
  const Wall& wall = survey.walls[0];
  EXPECT_EQ(wall.kind, WallKind::kWall);
  EXPECT_NEAR(wall.thickness, 0.05, 4.0 * wall.thickness_std);
  EXPECT_LT(wall.thickness_std, 0.0005);
  EXPECT_NEAR(wall.length, 4.0, 0.11);
  EXPECT_NEAR(wall.height, 2.5, 0.11);
  EXPECT_NEAR(wall.faces[0].rms, 0.003, 0.0005);
  EXPECT_EQ(wall.faces[0].points + wall.faces[1].points, sampler.cloud.positions.size());
  EXPECT_THAT(survey.faces, IsEmpty());
}

TEST(Survey, SurfacesThatLookAtEachOtherOrOneWayAreNoWall) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  const Eigen::Vector3d x(4, 0, 0);
  const Eigen::Vector3d z(0, 0, 2.5);
  sampler.add({0, 0.3, 0}, x, z);   // a corridor of 30 cm: looks to -y at ...
  sampler.add({4, 0.0, 0}, -x, z);  // ... what looks to +y
  const Survey corridor = survey_walls(sampler.cloud, {});
  EXPECT_THAT(corridor.walls, IsEmpty());
  EXPECT_THAT(corridor.faces, SizeIs(2));

  SurfaceSampler same(random);
  same.add({0, 0, 0}, x, z);  // a cupboard's front and the wall above it
  same.add({0, 0.4, 0}, x, 1.2 * z);
  EXPECT_THAT(survey_walls(same.cloud, {}).walls, IsEmpty());
}

// The front of a cupboard and the far side of the wall behind it are back to back.
TEST(Survey, ACupboardBeforeAWallIsFurniture) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  const Eigen::Vector3d z(0, 0, 2.5);
  sampler.add({4, 0.1, 0}, {-4, 0, 0}, z);
  sampler.add({0, 0, 0}, {1, 0, 0}, z);
  sampler.add({2.5, 0, 0}, {1.5, 0, 0}, z);
  sampler.add({1, 0, 1.5}, {1.5, 0, 0}, {0, 0, 1.0});
  sampler.add({1, -0.3, 0}, {1.5, 0, 0}, {0, 0, 1.5});
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(survey.walls, SizeIs(1));
  EXPECT_NEAR(survey.walls[0].thickness, 0.1, 0.001);
  ASSERT_THAT(kinds(survey.bodies), ElementsAre(WallKind::kFurniture));
  EXPECT_NEAR(survey.bodies[0].thickness, 0.4, 0.002);
}

TEST(Survey, ADoorLeafThatStandsOpenBeforeAWallIsADoor) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {5, 0}, 0.1, 2.5);
  sampler.add_wall({1, 0.2}, {1.9, 0.2}, 0.04, 2.0);
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(kinds(survey.walls), ElementsAre(WallKind::kDoor, WallKind::kWall));
  EXPECT_NEAR(survey.walls[0].thickness, 0.04, 0.001);
  EXPECT_NEAR(survey.walls[1].thickness, 0.1, 0.001);
}

TEST(Survey, WallsOfTwoThicknessesInOneLineAreTwo) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {3, 0}, 0.08, 2.5);
  sampler.add_wall({3.2, 0}, {6, 0}, 0.12, 2.5);
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(survey.walls, SizeIs(2));
  EXPECT_NEAR(survey.walls[0].thickness, 0.08, 0.001);
  EXPECT_NEAR(survey.walls[1].thickness, 0.12, 0.001);
}

TEST(Survey, LowLevelAndSlopedPairsSayWhatTheyAre) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {3, 0}, 0.06, 1.2);
  sampler.add({0, 5, 3.2}, {4, 0, 0}, {0, 3, 0});
  sampler.add({0, 5, 3.0}, {0, 3, 0}, {4, 0, 0});
  sampler.add({10, 0, 3}, {4, 0, 0}, {0, 2, 2});
  sampler.add({10, 0, 2.85}, {0, 2, 2}, {4, 0, 0});
  sampler.add_box({20, 0, 0}, {20.4, 0.4, 3});
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(
      kinds(survey.walls), ElementsAre(WallKind::kPartition, WallKind::kSloped, WallKind::kSlab));
  EXPECT_NEAR(survey.walls[1].thickness, 0.15 * std::sqrt(0.5), 0.001);
  EXPECT_NEAR(survey.walls[2].thickness, 0.2, 0.001);
  EXPECT_THAT(kinds(survey.bodies), ElementsAre(WallKind::kColumn, WallKind::kColumn));
}

TEST(Survey, ACurvedWallComesOutAsStripsOfItsThickness) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  constexpr int kFacets = 60;
  for (int i = 0; i < kFacets; ++i) {
    const double a = 1.5 * i / kFacets;
    const double b = 1.5 * (i + 1) / kFacets;
    const auto at = [](double radius, double angle) {
      return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    };
    const Eigen::Vector3d z(0, 0, 2.5);
    sampler.add(at(4.1, a), at(4.1, b) - at(4.1, a), z);
    sampler.add(at(4.0, b), at(4.0, a) - at(4.0, b), z);
  }
  const Survey survey = survey_walls(sampler.cloud, {});
  EXPECT_THAT(survey.walls, Not(IsEmpty()));
  for (const Wall& wall : survey.walls) {
    EXPECT_NEAR(wall.thickness, 0.1, 0.005);
  }
}

// The evaluation is told the faces; the survey is told nothing.
TEST(Survey, TheEvaluationThatKnowsTheFacesAgrees) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  const double thickness = 0.04;
  sampler.add_wall({0, 0}, {4, 0}, thickness, 2.5);
  eval::WallPiece piece;
  for (const std::size_t side : {0U, 1U}) {
    eval::WallFace& face = piece.faces[side];
    face.plane = {(side == 0 ? -1.0 : 1.0) * Eigen::Vector3d::UnitY(), 0.5 * thickness};
    face.center = {2.0, (side == 0 ? -0.5 : 0.5) * thickness, 1.25};
    face.u = Eigen::Vector3d::UnitX();
    face.v = Eigen::Vector3d::UnitZ();
    face.half_u = 2.0;
    face.half_v = 1.25;
  }
  piece.thickness = thickness;
  eval::OrientedCloud cloud;
  for (std::size_t i = 0; i < sampler.cloud.positions.size(); ++i) {
    cloud.points.push_back({sampler.cloud.positions[i], sampler.cloud.normals[i].cast<double>()});
  }
  const auto known = eval::measure_thickness(
      eval::wall_points(cloud, piece, {}), {piece.faces[0].plane, piece.faces[1].plane}, {});
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_TRUE(known.has_value());
  ASSERT_THAT(survey.walls, SizeIs(1));
  EXPECT_NEAR(survey.walls[0].thickness, known->value, 2e-4);
}

TEST(Survey, TheFrameOfTheMapDoesNotMatter) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {5, 0}, 0.07, 2.5);
  sampler.add_wall({0, 0.1}, {0, 4}, 0.12, 2.5);
  sampler.add({0.1, 0.1, 0}, {5, 0, 0}, {0, 4, 0});
  const Eigen::Isometry3d T = Eigen::Translation3d(500000.0, 5400000.0, 300.0) *
                              Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(0.2, Eigen::Vector3d(1.0, 0.4, 0.0).normalized());
  const Survey here = survey_walls(sampler.cloud, {});
  const Survey there = survey_walls(moved(sampler.cloud, T), {});
  ASSERT_THAT(here.walls, SizeIs(2));
  ASSERT_THAT(there.walls, SizeIs(2));
  EXPECT_LT((there.up - T.linear() * Eigen::Vector3d::UnitZ()).norm(), 0.01);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(there.walls[i].thickness, here.walls[i].thickness, 1e-4);
    EXPECT_EQ(there.walls[i].kind, WallKind::kWall);
    for (const Eigen::Vector3d& p : there.walls[i].faces[0].polygon) {
      EXPECT_NEAR(there.walls[i].faces[0].plane.distance(p), 0.0, 1e-6);
    }
  }
}

TEST(Survey, CornersAreWherePlanesMeet) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  const Eigen::Vector3d z(0, 0, 2.5);
  sampler.add({0, 0, 0}, {4, 0, 0}, {0, 3, 0});  // a room from inside
  sampler.add({0, 0, 2.5}, {0, 3, 0}, {4, 0, 0});
  sampler.add({0, 0, 0}, {0, 3, 0}, z);
  sampler.add({4, 3, 0}, {0, -3, 0}, z);
  sampler.add({4, 0, 0}, {-4, 0, 0}, z);
  sampler.add({0, 3, 0}, {4, 0, 0}, z);
  const Survey survey = survey_walls(sampler.cloud, {});
  ASSERT_THAT(survey.faces, SizeIs(6));
  for (const SurveyFace& face : survey.faces) {
    ASSERT_THAT(face.polygon, SizeIs(4));
    for (const Eigen::Vector3d& p : face.polygon) {
      const Eigen::Vector3d corner(p.x() > 2 ? 4 : 0, p.y() > 1.5 ? 3 : 0, p.z() > 1 ? 2.5 : 0);
      EXPECT_LT((p - corner).norm(), 0.005) << p.transpose();
    }
  }
}

TEST(Survey, BadPointsAreLeftOutAndCounted) {
  auto random = test::rng();
  SurfaceSampler sampler(random);
  sampler.add_wall({0, 0}, {4, 0}, 0.1, 2.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Vector3d& bad :
       {Eigen::Vector3d(nan, 0, 0), Eigen::Vector3d(0, HUGE_VAL, 0), Eigen::Vector3d(1e12, 0, 0)}) {
    sampler.cloud.positions.push_back(bad);
    sampler.cloud.normals.emplace_back(0.0F, 0.0F, 1.0F);
  }
  sampler.cloud.positions.emplace_back(0.0, 0.0, 1.0);
  sampler.cloud.normals.emplace_back(0.0F, 0.0F, 0.0F);
  const Survey survey = survey_walls(sampler.cloud, {});
  EXPECT_EQ(survey.left_out, 4U);
  EXPECT_THAT(survey.walls, SizeIs(1));
}

TEST(Survey, ClutterIsNoWall) {
  auto random = test::rng();
  std::uniform_real_distribution<double> share(-2.0, 2.0);
  std::normal_distribution<double> normal;
  io::MapCloud cloud;
  for (int i = 0; i < 5000; ++i) {
    cloud.positions.emplace_back(share(random), share(random), share(random));
    cloud.normals.push_back(
        Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized().cast<float>());
  }
  const Survey survey = survey_walls(cloud, {});
  EXPECT_THAT(survey.walls, IsEmpty());
  EXPECT_THAT(survey.bodies, IsEmpty());
}

TEST(Survey, WithoutNormalsOrWithBadOptionsItThrows) {
  io::MapCloud cloud;
  EXPECT_THROW(survey_walls(cloud, {}), std::invalid_argument);
  cloud.positions.resize(100, Eigen::Vector3d::Zero());
  EXPECT_THROW(survey_walls(cloud, {}), std::invalid_argument);
  cloud.normals.resize(100, Eigen::Vector3f::UnitX());
  EXPECT_THAT(survey_walls(cloud, {}).walls, IsEmpty());
  SurveyOptions options;
  options.min_area = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(survey_walls(cloud, options), std::invalid_argument);
}

}  // namespace
}  // namespace nvm::survey
