// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "sim/clearance.hpp"
#include "sim/lidar.hpp"
#include "sim/scene_file.hpp"
#include "sim/sequence_json.hpp"

namespace nvm::sim {
namespace {

/// Horizontal distance from `p` to where that path goes [m].
double distance_to_path(const Eigen::Vector3d& p, const std::vector<Eigen::Vector3d>& path) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d leg = (path[i] - path[i - 1]).head<2>();
    const Eigen::Vector2d from_start = (p - path[i - 1]).head<2>();
    const double share = std::clamp(from_start.dot(leg) / leg.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (from_start - share * leg).norm());
  }
  return least;
}

TEST(ShippedScenes, AreTheDocumentedOnes) {
  const auto names = shipped_scenes();
  const std::set<std::string> expected{
      "cafe",
      "flat",
      "flat_blank",
      "flat_busy",
      "garage",
      "office",
      "rooms",
      "seven_walls",
      "stairwell",
      "wall10",
      "wall15",
      "wall5"};
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), expected);
}

class ShippedScene : public ::testing::TestWithParam<std::string> {
 protected:
  ShippedScene() : scene_(load_scene(GetParam())), rays_(scene_) {}

  Scene scene_;
  RayCaster rays_;
};

INSTANTIATE_TEST_SUITE_P(
    All, ShippedScene, ::testing::ValuesIn(shipped_scenes()), [](const auto& name) {
      return name.param;
    });

TEST_P(ShippedScene, CanBeWalkedWithManySeeds) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Motion motion(scene_.route, {}, seed, 0.0);
    EXPECT_NO_THROW(check_clearance(scene_, rays_, motion, 0.25)) << "seed " << seed;
  }
}

TEST(ShippedScenes, KeepPeopleBesideTheRoute) {
  constexpr double kElbowRoom = 0.05;  // [m]
  const Scene scene = load_scene("flat_busy");
  ASSERT_FALSE(scene.people.empty());
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Motion motion(scene.route, {}, seed, 0.0);
    for (double time = 0.0; time < motion.duration(); time += 0.2) {
      const Eigen::Vector3d p = motion.pose(time).translation();
      for (const Person& person : scene.people) {
        EXPECT_GT(distance_to_path(p, person.path) - person.radius, kElbowRoom) << p.transpose();
      }
    }
  }
}

/// By a robot, and over the head, as far as its doors of 2 m let one.
TEST(ShippedScenes, FlatsCanBeWalkedLowAndHigh) {
  for (const std::string name : {"flat", "flat_blank", "flat_busy"}) {
    const Scene scene = load_scene(name);
    const RayCaster rays(scene);
    for (const double height : {0.3, 1.8}) {
      MotionOptions options;
      options.height = height;
      const Motion motion(scene.route, options, 1, 0.0);
      EXPECT_NO_THROW(check_clearance(scene, rays, motion, 0.1)) << name << " " << height;
    }
  }
}

/// 25 ms of a Mid-360 in every second show both faces of every piece of every listed wall.
TEST_P(ShippedScene, ShowsBothFacesOfEachListedWall) {
  const Motion motion(scene_.route, {}, 1, 0.0);
  LidarOptions options;
  options.scan_rate = 40.0;
  const Lidar lidar(find_sensor("mid360"), options, {scene_, rays_, motion}, 1);
  SurfaceHits hits(scene_);
  for (std::size_t second = 0; static_cast<double>(second + 1) < motion.duration(); ++second) {
    hits.count(lidar.scan(40 * second));
  }
  EXPECT_FALSE(scene_.wall_pieces.empty());
  constexpr std::size_t kMinHits = 10;
  for (const WallPiece& piece : scene_.wall_pieces) {
    for (int side = 0; side < 2; ++side) {
      EXPECT_GE(hits.on_face(piece.box, face_index(piece.axis, side)), kMinHits)
          << piece.wall << " piece " << piece.piece << " side " << side;
    }
  }
}

TEST_P(ShippedScene, IsClosed) {
  const Motion motion(scene_.route, {}, 1, 0.0);
  const Lidar lidar(find_sensor("os0_32"), {}, {scene_, rays_, motion}, 1);
  for (double time = 1.0; time < motion.duration() - 1.0; time += 30.0) {
    const SimulatedScan scan = lidar.scan(static_cast<std::size_t>(10.0 * time));
    EXPECT_EQ(scan.scan.points.size(), 32768U);
  }
}

/// The walls of a scene and how thick they are [m].
std::set<double> thicknesses(const std::string& name) {
  const Scene scene = load_scene(name);
  std::set<double> result;
  for (const WallPiece& piece : scene.wall_pieces) {
    result.insert(std::round(thickness(scene, piece) * 1e6) / 1e6);
  }
  return result;
}

TEST(ShippedScenes, HaveTheirThicknesses) {
  EXPECT_EQ(thicknesses("wall15"), std::set<double>({0.15}));
  EXPECT_EQ(thicknesses("wall10"), std::set<double>({0.10}));
  EXPECT_EQ(thicknesses("wall5"), std::set<double>({0.05}));
  EXPECT_EQ(
      thicknesses("seven_walls"), std::set<double>({0.03, 0.05, 0.07, 0.09, 0.11, 0.13, 0.15}));
  EXPECT_EQ(thicknesses("rooms"), std::set<double>({0.04, 0.10}));
  EXPECT_EQ(thicknesses("flat"), std::set<double>({0.04, 0.10}));
  EXPECT_EQ(thicknesses("cafe"), std::set<double>({0.04}));
  EXPECT_EQ(thicknesses("office"), std::set<double>({0.075}));
  EXPECT_EQ(thicknesses("stairwell"), std::set<double>({0.10, 0.20}));
}

}  // namespace
}  // namespace nvm::sim
