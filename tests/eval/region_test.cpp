// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/region.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "eval/synthetic_wall.hpp"
#include "eval/walls/wall_evaluation.hpp"
#include "support/rng.hpp"

namespace nvm::eval {
namespace {

using test::make_wall;
using test::rng;
using test::sample_wall;

Region region_around(double thickness) {
  Region region;
  region.name = "wall";
  region.size = Eigen::Vector3d(0.6, 3.0, 2.0);
  region.thickness = thickness;
  return region;
}

TEST(Region, MeasuresTheWallInItWithoutKnowingItsFaces) {
  auto random = rng();
  for (const double thickness : {0.15, 0.05, 0.03}) {
    double sum = 0.0;
    for (int i = 0; i < 40; ++i) {
      const Pose T = test::random_pose(random, 0.03, 0.02);
      const OrientedCloud cloud = sample_wall(random, make_wall(thickness, T));
      sum += evaluate_region(cloud, region_around(thickness), WallOptions()).error().value();
    }
    EXPECT_NEAR(sum / 40.0, 0.0, 0.2e-3) << thickness;
  }
}

TEST(Region, IsTurnedByRollPitchAndYaw) {
  auto random = rng();
  Pose T = Pose::Identity();
  T.linear() = so3_exp({0.0, 0.0, 0.5});
  T.translation() = Eigen::Vector3d(10.0, -4.0, 1.0);
  Region region = region_around(0.05);
  region.center = T.translation();
  region.rotation_deg = Eigen::Vector3d(0.0, 0.0, 0.5 * 180.0 / 3.14159265358979);
  region.size = Eigen::Vector3d(0.3, 3.8, 2.2);
  const auto wall = evaluate_region(sample_wall(random, make_wall(0.05, T)), region, WallOptions());
  EXPECT_NEAR(wall.error().value(), 0.0, 1.5e-3);
  EXPECT_GT(wall.points[0], 1600U);  // nothing but the corners is cut off
}

TEST(Region, PrefersTheDominantSurfaces) {
  auto random = rng();
  OrientedCloud cloud = sample_wall(random, make_wall(0.06));
  OrientedCloud shelf = sample_wall(random, make_wall(0.40), {300, 0.01, 1.0});
  cloud.points.insert(cloud.points.end(), shelf.points.begin(), shelf.points.end());
  const auto wall = evaluate_region(cloud, region_around(0.06), WallOptions());
  EXPECT_NEAR(wall.error().value(), 0.0, 1.5e-3);
}

TEST(Region, HasNoThicknessWithoutTwoSides) {
  auto random = rng();
  const Region region = region_around(0.0);
  OrientedCloud cloud;
  EXPECT_FALSE(evaluate_region(cloud, region, WallOptions()).thickness.has_value());
  test::sample_face(random, make_wall(0.1).faces[0], {}, cloud);
  EXPECT_FALSE(evaluate_region(cloud, region, WallOptions()).thickness.has_value());
  cloud = sample_wall(random, make_wall(0.1));
  for (OrientedPoint& sample : cloud.points) {
    sample.normal.setZero();
  }
  const auto wall = evaluate_region(cloud, region, WallOptions());
  EXPECT_FALSE(wall.thickness.has_value());
  EXPECT_FALSE(wall.true_thickness.has_value());
}

std::string write(const std::string& text) {
  const std::string path = ::testing::TempDir() + "nvm_regions.yaml";
  std::ofstream(path) << text;
  return path;
}

TEST(Regions, AreReadFromYaml) {
  const auto regions = read_regions(
      write("regions:\n"
            "  - {name: north, center: [1, 2, 3], size: [0.5, 2, 2], rotation_deg: [0, 0, 30]}\n"
            "  - {name: south, center: [0, 0, 1], size: [0.5, 1, 1], thickness: 0.1}\n"));
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].name, "north");
  EXPECT_EQ(regions[0].rotation_deg.z(), 30.0);
  EXPECT_EQ(regions[0].thickness, 0.0);
  EXPECT_EQ(regions[1].thickness, 0.1);
}

TEST(Regions, AreRefusedWithTheReason) {
  EXPECT_THROW(read_regions("/nowhere/regions.yaml"), std::runtime_error);
  EXPECT_THROW(read_regions(write("regions: [{name: a, size: [1, 1, 1]}]")), std::invalid_argument);
  EXPECT_THROW(
      read_regions(write("regions: [{name: a, center: [0, 0, 0], size: [1, -1, 1]}]")),
      std::invalid_argument);
}

}  // namespace
}  // namespace nvm::eval
