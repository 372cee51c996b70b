// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
// Mirrors, people and bright surfaces, in a hall.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "sim/lidar.hpp"
#include "sim/people.hpp"
#include "sim/scene_file.hpp"

namespace nvm::sim {
namespace {

constexpr double kRounding = 1e-5;  ///< of a point in single precision [m]

double range_of(const TimedPoint& point) {
  return Eigen::Vector3d(point.x, point.y, point.z).norm();
}

/// A hall of 12 by 8 m with `more` in it, seen without noise by a sensor that walks at its middle.
class Hall {
 public:
  explicit Hall(
      const std::string& more, const std::string& sensor = "mid360", double blooming = 0.0)
      : scene_(parse_scene(
            "hulls: [{name: hall, min: [-6, -4, 0], max: [6, 4, 3]}]\n"
            "materials: {looking_glass: {mirror: 1.0}, sign: {reflectivity: 1.0}}\n"
            "route: {waypoints: [[-1, 0], [1, 0]]}\n" +
                more,
            "hall.yaml")),
        rays_(scene_),
        motion_(scene_.route, {}, 1, 10.0),
        lidar_(find_sensor(sensor), options_with(blooming), {scene_, rays_, motion_}, 1),
        simulated_(lidar_.scan(60)) {}

  std::size_t size() const { return simulated_.truth.size(); }
  const ReturnTruth& truth(std::size_t i) const { return simulated_.truth[i]; }
  double range(std::size_t i) const { return range_of(simulated_.scan.points[i]); }
  const std::string& object(std::size_t i) const {
    return object_name(scene_, truth(i).surface.object);
  }

  /// Where return `i` seems to come from, in the world frame [m].
  Eigen::Vector3d place(std::size_t i) const {
    const TimedPoint& point = simulated_.scan.points[i];
    const double time = simulated_.scan.t_begin + static_cast<double>(point.dt);
    return motion_.pose(time) * lidar_.extrinsic() * Eigen::Vector3d(point.x, point.y, point.z);
  }

 private:
  static LidarOptions options_with(double blooming) {
    LidarOptions options;
    options.range_noise = 0.0;
    options.blooming = blooming;
    return options;
  }

  Scene scene_;
  RayCaster rays_;
  Motion motion_;
  Lidar lidar_;
  SimulatedScan simulated_;
};

/// A picture is never nearer than what the mirror hides, which is a mirror's thickness behind it at
/// most: light that goes on to the floor, or from it, comes as far as without the mirror.
TEST(Mirrors, ShowTheRoomBehindThem) {
  const Hall with("boxes: [{min: [-2, 3.9, 0], max: [2, 4, 2.5], material: looking_glass}]\n");
  const Hall without("");
  ASSERT_EQ(with.size(), without.size());
  std::size_t behind = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (with.truth(i).origin == Origin::kMirror) {
      behind += with.range(i) > without.range(i) + 0.5 ? 1 : 0;
      EXPECT_GE(with.range(i), without.range(i) - kRounding);
    } else {
      EXPECT_NEAR(with.range(i), without.range(i), kRounding);
    }
  }
  EXPECT_GT(behind, 300U);
}

/// Light that goes 3.9 m to the mirror and 8 m less its thickness back seems to come from a wall
/// behind it.
TEST(Mirrors, ShowAWallAsAPlane) {
  const Hall hall("boxes: [{min: [-6, 3.9, 0], max: [6, 4, 3], material: looking_glass}]\n");
  std::size_t pictures = 0;
  for (std::size_t i = 0; i < hall.size(); ++i) {
    if (hall.truth(i).origin == Origin::kMirror && hall.object(i) == "hall_south") {
      ++pictures;
      EXPECT_NEAR(hall.place(i).y(), 3.9 + 3.9 + 4.0, kRounding);
    }
  }
  EXPECT_GT(pictures, 100U);
}

TEST(Mirrors, ThatFaceEachOtherReturnNothingFromTheirDepths) {
  const Hall hall(
      "boxes: [{min: [-6, 3.9, 0], max: [6, 4, 3], material: looking_glass},"
      "        {min: [-6, -4, 0], max: [6, -3.9, 3], material: looking_glass}]\n");
  EXPECT_LT(hall.size(), 20000U);
  EXPECT_GT(hall.size(), 10000U);
}

TEST(People, StandInTheWayOfWhatIsBehindThem) {
  const Hall with("people: [{path: [[3, 0], [3, 0.001]], radius: 0.3, height: 1.7}]\n");
  const Hall without("");
  ASSERT_EQ(with.size(), without.size());
  std::size_t on_people = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (with.truth(i).origin == Origin::kPerson) {
      ++on_people;
      EXPECT_LT(with.range(i), without.range(i));
      EXPECT_LT(with.place(i).z(), 1.7 + kRounding);
      EXPECT_NEAR((with.place(i) - Eigen::Vector3d(3, 0, 0)).head<2>().norm(), 0.3, 2e-3);
    } else {
      EXPECT_EQ(with.range(i), without.range(i));
    }
  }
  EXPECT_GT(on_people, 100U);
}

TEST(People, WalkToAndFro) {
  Person person;
  person.path = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  person.speed = 0.5;
  EXPECT_LT((place_of(person, 0.0) - Eigen::Vector3d(0, 0, 0)).norm(), 1e-12);
  EXPECT_LT((place_of(person, 2.0) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((place_of(person, 5.0) - Eigen::Vector3d(2, 0.5, 0)).norm(), 1e-12);
  EXPECT_LT((place_of(person, 6.0) - Eigen::Vector3d(2, 1, 0)).norm(), 1e-12);
  EXPECT_LT((place_of(person, 7.0) - Eigen::Vector3d(2, 0.5, 0)).norm(), 1e-12);
  EXPECT_LT((place_of(person, 11.0) - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-12);
  EXPECT_LT((place_of(person, 13.0) - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-12);
}

const std::string kSign = "boxes: [{min: [2.9, -1, 0.5], max: [3, 1, 2.5], material: sign}]\n";

/// How far `p` is from the sign, across x [m].
double beside_the_sign(const Eigen::Vector3d& p) {
  const Eigen::Vector2d nearest(std::clamp(p.y(), -1.0, 1.0), std::clamp(p.z(), 0.5, 2.5));
  return (Eigen::Vector2d(p.y(), p.z()) - nearest).norm();
}

/// Seen from x < 1. A return has the range of a place on the sign that is up to a degree beside it.
TEST(BrightSurfaces, BloomBeyondTheirEdgesByADegree) {
  const Hall with(kSign, "os0_128", 1.0);
  const Hall without(kSign, "os0_128");
  ASSERT_EQ(with.size(), without.size());
  constexpr double kDegree = M_PI / 180.0;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (with.truth(i).origin != Origin::kBlooming) {
      EXPECT_EQ(with.range(i), without.range(i));
      continue;
    }
    const double beside = beside_the_sign(with.place(i));
    EXPECT_LT(beside, kDegree * with.range(i) + kRounding);
    beyond += beside > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(beyond, 30U);
}

}  // namespace
}  // namespace nvm::sim
