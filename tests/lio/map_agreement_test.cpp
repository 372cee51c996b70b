// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/map/map_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "nvm/geometry/pose.hpp"
#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::lio {
namespace {

class MapAgreementOfRoom : public ::testing::Test {
 protected:
  MapAgreementOfRoom() {
    MapOptions options;
    options.capacity = 50'000;
    options.min_point_distance = 0.07;
    map_ = make_map(MapType::kNvm, options);
    const test::RoomScan scan = room_.scan(Pose::Identity(), 20'000, 0.0, random_);
    map_->insert(
        scan.points, scan.normals, std::vector<PointValues>(scan.points.size()), Pose::Identity());
  }

  test::Room room_;
  std::mt19937_64 random_ = test::rng();
  std::unique_ptr<LioMap> map_;
};

TEST_F(MapAgreementOfRoom, DistanceOfAFlatWallIsWhatItWasMovedBy) {
  test::RoomScan floor;
  const test::RoomScan scan = room_.scan(Pose::Identity(), 3000, 0.0, random_);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    if (scan.normals[i].z() > 0.9F && p.z() < -1.4F && p.head<2>().norm() < 0.8F) {
      floor.points.push_back(p);
      floor.normals.push_back(scan.normals[i]);
    }
  }
  ASSERT_GT(floor.points.size(), 20U);
  for (const double height : {0.0, 0.01, 0.03, 0.05, 0.2}) {
    Pose moved = Pose::Identity();
    moved.translation().z() = height;
    EXPECT_NEAR(
        distance_from_map(*map_, floor.points, floor.normals, moved), std::min(height, 0.06), 2e-4)
        << height;
  }
}

TEST_F(MapAgreementOfRoom, DistanceIsLeastAtTheTruePose) {
  const test::RoomScan scan = room_.scan(Pose::Identity(), 3000, 0.01, random_);
  const double there = distance_from_map(*map_, scan.points, scan.normals, Pose::Identity());
  EXPECT_LT(there, 0.02);
  for (int axis = 0; axis < 3; ++axis) {
    Pose moved = Pose::Identity();
    moved.translation()[axis] = 0.03;
    EXPECT_GT(distance_from_map(*map_, scan.points, scan.normals, moved), 1.15 * there) << axis;
    moved = Pose::Identity();
    moved.linear() = so3_exp(0.03 * Eigen::Vector3d::Unit(axis));
    EXPECT_GT(distance_from_map(*map_, scan.points, scan.normals, moved), 1.15 * there) << axis;
  }
}

TEST_F(MapAgreementOfRoom, UnknownSpaceIsAsFarAsAnythingAndSightingsAreLeftOut) {
  const test::RoomScan scan = room_.scan(Pose::Identity(), 300, 0.0, random_);
  Pose elsewhere = Pose::Identity();
  elsewhere.translation().x() = 100.0;
  EXPECT_NEAR(distance_from_map(*map_, scan.points, scan.normals, elsewhere), 0.06, 1e-9);
  std::vector<Eigen::Vector3f> sightings = scan.normals;
  for (Eigen::Vector3f& normal : sightings) {
    normal *= 0.5F;
  }
  EXPECT_EQ(distance_from_map(*map_, scan.points, sightings, elsewhere), 0.0);
  EXPECT_EQ(distance_from_map(*map_, {}, {}, elsewhere), 0.0);
}

}  // namespace
}  // namespace nvm::lio
