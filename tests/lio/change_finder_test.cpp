// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/change/change_finder.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "sim/ray_caster.hpp"
#include "sim/scene_file.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

using ::testing::IsEmpty;

/// Two rooms with a wall of 10 cm and a doorway between them; `door` and `more` are lists of boxes.
std::string rooms(const std::string& boxes) {
  return R"yaml(
description: two rooms
hulls:
  - {name: shell, min: [-6, 0, 0], max: [6, 5, 2.6]}
walls:
  - {name: divider, from: [0, 0], to: [0, 5], thickness: 0.1, height: 2.6, openings: [{from: 3.4, to: 4.4}]}
boxes:
  - {name: cupboard, min: [-5.9, 0.1, 0.1], max: [-4.6, 0.6, 2.0]}
  - {name: bench, min: [2.4, 0.1, 0.1], max: [4.6, 0.5, 0.5]}
)yaml" + boxes;
}

const std::string kShut = "  - {name: door, min: [-0.02, 3.4, 0.1], max: [0.02, 4.4, 2.5]}\n";
const std::string kOpen = "  - {name: door, min: [-1.0, 3.36, 0.1], max: [0.0, 3.4, 2.5]}\n";
const std::string kChest = "  - {name: chest, min: [-3.0, 3.4, 0.1], max: [-2.0, 4.0, 0.9]}\n";
const std::string kChestMoved = "  - {name: chest, min: [-3.8, 1.4, 0.1], max: [-2.8, 2.0, 0.9]}\n";

Pose at(double x, double y, double yaw) {
  Pose pose = Pose::Identity();
  pose.translation() << x, y, 1.3;
  pose.linear() = so3_exp({0.0, 0.0, yaw});
  return pose;
}

class Changes : public ::testing::Test {
 protected:
  static constexpr double kRangeNoise = 0.02;  // [m]

  struct Look {
    DeskewedScan scan;
    std::vector<Eigen::Vector3f> normals;
  };

  Look look(const sim::RayCaster& rays, const Pose& T_map_scan, std::size_t count, double noise) {
    std::normal_distribution<double> normal;
    Look look;
    while (look.scan.points.size() < count) {
      const Eigen::Vector3d direction =
          Eigen::Vector3d(normal(random_), normal(random_), normal(random_)).normalized();
      const auto hit = rays.cast(T_map_scan.translation(), T_map_scan.linear() * direction, 30.0);
      if (hit) {
        look.scan.points.push_back(
            (direction * (hit->range + noise * normal(random_))).cast<float>());
        look.normals.push_back(
            (T_map_scan.linear().transpose() * hit->normal).cast<float>().normalized());
      }
    }
    look.scan.viewpoints.assign(count, Eigen::Vector3f::Zero());
    look.scan.ages.assign(count, 0.0F);
    return look;
  }

  VoxelMap map_of(const std::string& scene_text) {
    const sim::Scene scene = sim::parse_scene(scene_text, "test");
    const sim::RayCaster rays(scene);
    MapOptions options;
    options.min_point_distance = 0.07;
    VoxelMap map(options);
    for (const Pose& place :
         {at(-4, 3, 0), at(-1.5, 1, 0), at(-3.5, 1, 1), at(-1, 4.5, 0), at(2, 4, 0), at(4, 2, 1)}) {
      const Look seen = look(rays, place, 20'000, 0.003);
      map.insert(seen.scan.points, seen.normals, place);
    }
    return map;
  }

  /// Walks through the scene with poses that err by 1 cm and 2 mrad.
  void watch(const std::string& scene_text, ChangeFinder& finder) {
    const sim::Scene scene = sim::parse_scene(scene_text, "test");
    const sim::RayCaster rays(scene);
    std::normal_distribution<double> normal;
    const auto shaky = [&](double deviation) {
      return Eigen::Vector3d(
          deviation * normal(random_), deviation * normal(random_), deviation * normal(random_));
    };
    for (int i = 0; i <= 12; ++i) {
      const Pose place = at(-4.5 + 0.65 * i, 2.6 + 0.1 * i, 0.3 * i);
      const Look seen = look(rays, place, 12'000, kRangeNoise);
      Pose estimate = place;
      estimate.translation() += shaky(0.01);
      estimate.linear() = so3_exp(shaky(0.002)) * place.linear();
      finder.add(seen.scan, seen.normals, estimate);
    }
  }

  std::mt19937_64 random_ = test::rng();
};

TEST_F(Changes, AreNoneInASceneThatStayedAsItWas) {
  const VoxelMap map = map_of(rooms(kShut + kChest));
  ChangeFinder finder(map);
  watch(rooms(kShut + kChest), finder);
  EXPECT_EQ(finder.scans(), 13U);
  EXPECT_THAT(finder.gone(), IsEmpty());
  EXPECT_THAT(finder.added(), IsEmpty());
}

TEST_F(Changes, TellWhereFurnitureWasAndIs) {
  const VoxelMap map = map_of(rooms(kShut + kChest));
  ChangeFinder finder(map);
  watch(rooms(kShut + kChestMoved), finder);
  const std::vector<ChangedPlace> gone = finder.gone();
  const std::vector<ChangedPlace> added = finder.added();
  ASSERT_EQ(gone.size(), 1U);
  ASSERT_EQ(added.size(), 1U);
  EXPECT_LT((gone[0].center - Eigen::Vector3d(-2.5, 3.7, 0.6)).norm(), 0.4);
  EXPECT_LT((added[0].center - Eigen::Vector3d(-3.3, 1.7, 0.6)).norm(), 0.4);
  for (const ChangedPlace& place : {gone[0], added[0]}) {  // a top of 0.6 m^2 and some sides
    EXPECT_GT(place.area, 0.5);
    EXPECT_LT(place.area, 3.5);
  }
}

TEST_F(Changes, TellThatADoorWasOpened) {
  const VoxelMap map = map_of(rooms(kShut + kChest));
  ChangeFinder finder(map);
  watch(rooms(kOpen + kChest), finder);
  ASSERT_FALSE(finder.gone().empty());
  ASSERT_FALSE(finder.added().empty());
  EXPECT_LT((finder.gone()[0].center - Eigen::Vector3d(0.0, 3.9, 1.3)).norm(), 0.4);
  EXPECT_LT((finder.added()[0].center - Eigen::Vector3d(-0.5, 3.4, 1.3)).norm(), 0.4);
  EXPECT_NEAR(finder.gone()[0].area, 2.4, 1.0);
}

TEST_F(Changes, AreNotPeopleWhoPass) {
  const VoxelMap map = map_of(rooms(kShut));
  ChangeFinder finder(map);
  for (int i = 0; i < 6; ++i) {
    const std::string x = std::to_string(-5.0 + 0.5 * i);
    const std::string y = std::to_string(-4.7 + 0.5 * i);
    const sim::Scene scene = sim::parse_scene(
        rooms(kShut + "  - {name: person, min: [" + x + ", 1.0, 0.1], max: [" + y + ", 1.4, 1.7]}"),
        "test");
    const sim::RayCaster rays(scene);
    const Look seen = look(rays, at(-2, 3, 0), 12'000, kRangeNoise);
    finder.add(seen.scan, seen.normals, at(-2, 3, 0));
  }
  EXPECT_THAT(finder.gone(), IsEmpty());
  EXPECT_THAT(finder.added(), IsEmpty());
}

TEST_F(Changes, AreNotPeopleWhoStandForAWhile) {
  const VoxelMap map = map_of(rooms(kShut));
  ChangeFinder finder(map);
  const auto add = [&](const std::string& more, int count) {
    const sim::Scene scene = sim::parse_scene(rooms(kShut + more), "test");
    const sim::RayCaster rays(scene);
    for (int i = 0; i < count; ++i) {
      const Look seen = look(rays, at(-2, 3, 0), 12'000, kRangeNoise);
      finder.add(seen.scan, seen.normals, at(-2, 3, 0));
    }
  };
  add("  - {name: person, min: [-4.2, 1.0, 0.1], max: [-3.9, 1.4, 1.7]}", 4);
  EXPECT_FALSE(finder.added().empty());
  add("", 25);
  EXPECT_THAT(finder.added(), IsEmpty());
}

/// Four scans whose lines of sight pass a plate from x = 0 to 1 m at `x` [m], and `later` ones
/// whose lines end there.
std::vector<ChangedPlace> gone_where_lines_pass(double x, int later = 0) {
  MapOptions options;
  options.min_point_distance = 0.07;
  VoxelMap map(options);
  std::vector<Eigen::Vector3f> plate;
  for (int i = 0; i < 15 * 15; ++i) {
    plate.emplace_back(
        static_cast<float>(i % 15) / 14.0F, 2.0F, static_cast<float>(i / 15) / 14.0F);
  }
  map.insert(plate, std::vector<Eigen::Vector3f>(plate.size(), {0.0F, -1.0F, 0.0F}));
  ChangeFinder finder(map);
  for (int k = 0; k < 4 + later; ++k) {
    Pose T_map_scan = Pose::Identity();
    T_map_scan.translation() << 0.5 + 0.1 * k, 0.0, 0.5;
    DeskewedScan scan;
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d passage(x, 2.0, 0.02 * i);
      scan.points.push_back(((k < 4 ? 2.0 : 1.0) * (T_map_scan.inverse() * passage)).cast<float>());
    }
    scan.viewpoints.assign(scan.size(), Eigen::Vector3f::Zero());
    finder.add(scan, std::vector<Eigen::Vector3f>(scan.size(), {0.0F, -1.0F, 0.0F}), T_map_scan);
  }
  return finder.gone();
}

TEST(ChangeFinder, TakesNoFaceForGoneThatLaterScansMeet) {
  EXPECT_FALSE(gone_where_lines_pass(0.8).empty());
  EXPECT_THAT(gone_where_lines_pass(0.8, 4), IsEmpty());
}

TEST(ChangeFinder, TakesNoFaceForGoneBesideWhoseEdgeOneSees) {
  EXPECT_FALSE(gone_where_lines_pass(0.8).empty());
  EXPECT_THAT(gone_where_lines_pass(1.03), IsEmpty());
}

TEST_F(Changes, ComeTheSameWhateverTheirOrder) {
  std::vector<ChangedSurface> surfaces;
  for (int i = 0; i < 40; ++i) {
    const double x = 0.1 * (i % 20) + (i < 20 ? 0.0 : 5.0);
    surfaces.push_back({{x, 0.0, 0.0}, {1.0F, 0.0F, 0.0F}, i < 20 ? 0.01 : 0.02});
  }
  surfaces.push_back({{20.0, 0.0, 0.0}, {1.0F, 0.0F, 0.0F}, 0.01});  // too small
  for (int round = 0; round < 3; ++round) {
    const std::vector<ChangedPlace> places = changed_places(surfaces);
    ASSERT_EQ(places.size(), 2U);
    EXPECT_NEAR(places[0].area, 0.4, 1e-9);
    EXPECT_NEAR(places[0].center.x(), 5.95, 1e-9);
    EXPECT_EQ(places[1].surfaces.size(), 20U);
    std::shuffle(surfaces.begin(), surfaces.end(), random_);
  }
}

}  // namespace
}  // namespace nvm::lio
