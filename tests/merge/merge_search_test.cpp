// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "merge/merge.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "two_rooms.hpp"

namespace nvm::merge {
namespace {

using test::at;
using test::doorway;
using test::east;
using test::joined;
using test::kElsewhere;
using test::kHall;
using test::kRooms;
using test::MergeTest;
using test::west;
using ::testing::HasSubstr;

TEST_F(MergeTest, JoinsTheTwoSidesOfAWallByTheDoorway) {
  const std::vector<Session> sessions = both_rooms();
  const Merged result = merged(sessions);
  EXPECT_LT(error(result.fits[1], kElsewhere), 0.005);
  EXPECT_GT(result.fits[1].overlap, 0.3);
  EXPECT_LT(result.fits[1].contradiction, 0.01);
  EXPECT_GT(result.map.size(), sessions[0].map.size() + 1000);
  // The faces of the divider, each of which one session alone saw well.
  double west_sum = 0.0;
  double east_sum = 0.0;
  std::size_t west_points = 0;
  std::size_t east_points = 0;
  result.map.for_each_point([&](const MapPoint& point) {
    if (std::abs(point.position.x()) < 0.15 && point.position.y() < 3.0 &&
        std::abs(point.normal.x()) > 0.95F) {
      (point.normal.x() < 0.0F ? west_sum : east_sum) += point.position.x();
      ++(point.normal.x() < 0.0F ? west_points : east_points);
    }
  });
  ASSERT_GT(west_points, 100U);
  ASSERT_GT(east_points, 100U);
  const double thickness =
      east_sum / static_cast<double>(east_points) - west_sum / static_cast<double>(west_points);
  EXPECT_NEAR(thickness, 0.1, 0.003);
}

TEST_F(MergeTest, ASessionMayWaitForTheOneThatConnectsIt) {
  std::vector<Session> sessions;
  sessions.push_back(session(kRooms, west(), Pose::Identity()));
  sessions.push_back(session(kRooms, east(), kElsewhere));
  sessions.push_back(session(kRooms, joined(west(), joined(doorway(), east())), at(1, 1)));
  const Merged result = merged(sessions);
  EXPECT_LT(error(result.fits[1], kElsewhere), 0.01);
  EXPECT_LT(error(result.fits[2], at(1, 1)), 0.01);
}

TEST_F(MergeTest, OriginsThatAreNotTrueDoNotHinderTheSearch) {
  std::vector<Session> sessions = both_rooms();
  sessions[0].origin << 465100.0, 5531200.0, 300.0;
  sessions[1].origin << 465200.0, 5531200.0, 300.0;
  EXPECT_LT(error(merged(sessions).fits[1], kElsewhere), 0.005);
}

TEST_F(MergeTest, RefusesMapsThatAreNotLevelAndNamesTheGuess) {
  EXPECT_THAT(
      refusal(both_rooms(tilted())), HasSubstr("--guess, which maps that are not level need"));
}

TEST_F(MergeTest, RefusesAnotherBuilding) {
  std::vector<Session> sessions;
  sessions.push_back(session(kRooms, joined(west(), doorway()), Pose::Identity()));
  sessions.push_back(session(kHall, {at(-7, 0), at(-4, 4), at(1, 3)}, Pose::Identity()));
  EXPECT_THAT(refusal(sessions), HasSubstr("run: "));
}

}  // namespace
}  // namespace nvm::merge
