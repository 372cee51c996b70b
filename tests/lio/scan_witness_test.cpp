// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/scan_witness.hpp"

#include <gtest/gtest.h>

#include "lio/place/place_judge.hpp"
#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::lio {
namespace {

constexpr double kSpacing = 0.11;  // more than the map's own, whatever the rounding [m]

Pose at(double x, double y) {
  Pose pose = Pose::Identity();
  pose.translation() << x, y, 0.0;
  return pose;
}

/// A wall at x = `distance` [m], from -2 m to `edge` along y.
void add_wall(double distance, double edge, std::vector<Eigen::Vector3f>& points) {
  for (double y = -2.0; y < edge; y += kSpacing) {
    for (double z = -1.0; z < 1.0; z += kSpacing) {
      points.emplace_back(
          static_cast<float>(distance), static_cast<float>(y), static_cast<float>(z));
    }
  }
}

VoxelMap map_of(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& normal) {
  VoxelMap map;
  map.insert(points, std::vector<Eigen::Vector3f>(points.size(), normal));
  return map;
}

/// What a point at (x, y, -0.01), seen from the origin and facing it, says of the origin.
Testimony asked(const VoxelMap& map, float x, float y) {
  const ScanWitness witness({{x, y, -0.01F}}, {-Eigen::Vector3f::UnitX()});
  return witness.testify(map, Pose::Identity()).front();
}

TEST(ScanWitness, SpeaksForFacesAndAgainstWhatItSeesThrough) {
  std::vector<Eigen::Vector3f> wall;
  add_wall(3.0, 1.0, wall);
  const VoxelMap map = map_of(wall, -Eigen::Vector3f::UnitX());
  EXPECT_EQ(asked(map, 3.0F, -0.02F), Testimony::kFor);
  EXPECT_EQ(asked(map, 6.0F, -0.02F), Testimony::kAgainst);   // through the wall
  EXPECT_EQ(asked(map, 3.08F, -0.02F), Testimony::kAgainst);  // behind its face
  EXPECT_EQ(asked(map, 2.91F, -0.02F), Testimony::kAgainst);  // in front of it
  EXPECT_EQ(asked(map, 1.5F, -0.02F), Testimony::kNone);      // something that was not there
}

TEST(ScanWitness, SaysNothingBesideTheEdgeOfAFaceOrThroughItsBack) {
  std::vector<Eigen::Vector3f> wall;
  add_wall(3.0, 1.0, wall);
  EXPECT_EQ(asked(map_of(wall, -Eigen::Vector3f::UnitX()), 6.0F, 1.96F), Testimony::kNone);
  EXPECT_EQ(asked(map_of(wall, Eigen::Vector3f::UnitX()), 6.0F, -0.02F), Testimony::kNone);
}

TEST(ScanWitness, PointsOfARoomSpeakForTheirPlaceAndAgainstOthers) {
  auto random = test::rng();
  const test::Room room;
  VoxelMap map;
  for (const Pose& place : {at(0.0, 0.0), at(2.0, 1.5), at(-3.0, 2.0), at(1.0, -2.0)}) {
    const test::RoomScan scan = room.scan(place, 20'000, 0.005, random);
    map.insert(scan.points, scan.normals, place);
  }
  const test::RoomScan scan = room.scan(at(0.5, 0.5), 5000, 0.005, random);
  const ScanWitness witness(scan.points, scan.normals);
  const Testimonies here = witness.testify(map, at(0.5, 0.5));
  const Testimonies there = witness.testify(map, at(1.5, 0.5));
  EXPECT_GT(count(here, Testimony::kFor), 9 * witness.size() / 10);
  EXPECT_LT(count(here, Testimony::kAgainst), witness.size() / 100);
  EXPECT_GT(count(there, Testimony::kAgainst), witness.size() / 25);
  EXPECT_GT(count_only(there, here, Testimony::kAgainst), witness.size() / 25);
}

/// A row of rooms of 4 x 4 m without doors, alike but for a pillar in the first.
struct Row {
  VoxelMap map;
  std::vector<Eigen::Vector3f> points, normals;  ///< of a scan in the middle of the first

  explicit Row(bool has_pillar) {
    for (const double room : {0.0, 4.2, 8.4}) {
      std::vector<Eigen::Vector3f> own, facing;
      for (double a = -1.95; a < 2.0; a += kSpacing) {
        for (double b = -1.95; b < 2.0; b += kSpacing) {
          add(a, 2.0, b, -Eigen::Vector3f::UnitY(), own, facing);
          add(a, -2.0, b, Eigen::Vector3f::UnitY(), own, facing);
          if (!has_pillar || room > 0.0 || a < 0.0 || a > 0.7) {  // what the pillar does not hide
            add(2.0, a, b, -Eigen::Vector3f::UnitX(), own, facing);
          }
          add(-2.0, a, b, Eigen::Vector3f::UnitX(), own, facing);
        }
      }
      for (double a = 0.05; a < 0.5 && has_pillar && room == 0.0; a += kSpacing) {
        for (double b = -1.95; b < 2.0; b += kSpacing) {
          add(1.5, a, b, -Eigen::Vector3f::UnitX(), own, facing);
        }
      }
      map.insert(own, facing, at(room, 0.0));
      if (room == 0.0) {
        points = own;
        normals = facing;
      }
    }
  }

  static void add(
      double x,
      double y,
      double z,
      const Eigen::Vector3f& normal,
      std::vector<Eigen::Vector3f>& points,
      std::vector<Eigen::Vector3f>& normals) {
    points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
    normals.push_back(normal);
  }

  Place judge() const {
    std::vector<Place> places;
    for (const double room : {0.0, 4.2, 8.4}) {
      places.push_back({at(room, 0.0), 0.99, 0.01, 0, ""});
    }
    return judged(places, map, ScanWitness(points, normals));
  }
};

TEST(PlaceJudge, ClaimsNoneOfSeveralRoomsThatAreAlike) {
  const Place place = Row(false).judge();
  EXPECT_FALSE(place.is_found());
  EXPECT_NE(place.why_not.find("3 places look alike"), std::string::npos) << place.why_not;
}

TEST(PlaceJudge, ClaimsTheRoomThatDiffers) {
  const Place place = Row(true).judge();
  EXPECT_TRUE(place.is_found()) << place.why_not;
  EXPECT_EQ(place.T_map_scan.translation().x(), 0.0);
}

}  // namespace
}  // namespace nvm::lio
