// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "merge/merge.hpp"

#include <gmock/gmock.h>

#include "two_rooms.hpp"

namespace nvm::merge {
namespace {

using test::at;
using test::kElsewhere;
using test::kRooms;
using test::MergeTest;
using ::testing::AnyOf;
using ::testing::HasSubstr;

TEST_F(MergeTest, TakesAGuess) {
  Pose guess = kElsewhere.inverse();
  guess.translation() += Eigen::Vector3d(0.4, -0.3, 0.1);
  EXPECT_LT(error(merged(both_rooms(), {guess}).fits[1], kElsewhere), 0.005);
}

TEST_F(MergeTest, RefusesAPlaceFarFromTheGuess) {
  for (const auto& [distance, turn] : {std::pair(4.0, 0.0), {0.0, 3.14}, {0.0, 0.6}}) {
    Pose guess = kElsewhere.inverse();
    guess.translation().x() += distance;
    guess.linear() *= so3_exp({0.0, 0.0, turn});
    try {
      const SessionFit fit = merged(both_rooms(), {guess}).fits[1];
      FAIL() << "placed at " << error(fit, kElsewhere);
    } catch (const std::runtime_error& refusal) {
      EXPECT_THAT(
          refusal.what(), AnyOf(HasSubstr("near the guess"), HasSubstr("does not overlap")));
    }
  }
}

TEST_F(MergeTest, TakesAGuessInTheFirstSessionsCoordinates) {
  std::vector<Session> sessions = both_rooms();
  sessions[0].origin << 465100.0, 5531200.0, 300.0;
  Pose guess = kElsewhere.inverse();
  guess.translation() += sessions[0].origin;
  EXPECT_LT(error(merged(sessions, {guess}).fits[1], kElsewhere), 0.005);
}

TEST_F(MergeTest, TakesAGuessOfAMapThatIsNotLevel) {
  EXPECT_LT(error(merged(both_rooms(tilted()), {tilted().inverse()}).fits[1], tilted()), 0.005);
}

TEST_F(MergeTest, TwoOriginsInOneGridTellHowSessionsLie) {
  const Eigen::Vector3d apart(-20.0, 10.0, 0.5);
  Pose T_session_world = Pose::Identity();
  T_session_world.translation() = -apart;
  std::vector<Session> sessions = both_rooms(T_session_world);
  sessions[0].origin << 465100.0, 5531200.0, 300.0;
  sessions[1].origin = sessions[0].origin + apart;
  EXPECT_LT(error(merged(sessions).fits[1], T_session_world), 0.005);
}

TEST_F(MergeTest, RefusesASessionWithoutKeyframes) {
  std::vector<Session> sessions = both_rooms();
  sessions[1].keyframes.clear();
  EXPECT_THAT(refusal(sessions), HasSubstr("does not overlap"));
}

TEST_F(MergeTest, RefusesTheOtherRoomWhereNothingConnects) {
  std::vector<Session> sessions;
  sessions.push_back(session(kRooms, {at(-5, 1.5), at(-4, 1.5), at(-4, 2)}, Pose::Identity()));
  sessions.push_back(session(kRooms, {at(4, 1.5), at(4, 2), at(4.5, 1.5)}, kElsewhere));
  EXPECT_THAT(refusal(sessions), HasSubstr("run: "));
}

TEST_F(MergeTest, RefusesMapsOfOtherVoxelSizes) {
  MapOptions coarse;
  coarse.voxel_size = 0.5;
  std::vector<Session> sessions;
  sessions.push_back(session(kRooms, {at(-3, 3)}, Pose::Identity()));
  sessions.push_back(session(kRooms, {at(-3, 3)}, Pose::Identity(), coarse));
  EXPECT_THAT(refusal(sessions), HasSubstr("voxels of 0.5 m"));
}

}  // namespace
}  // namespace nvm::merge
