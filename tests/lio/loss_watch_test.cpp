// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/loss_watch.hpp"

#include <gtest/gtest.h>

namespace nvm::lio {
namespace {

/// Tells `watch` of scans that were believed, from `begin` to `end` [s].
void track(LossWatch& watch, double begin, double end, double interval, bool by_imu = false) {
  for (double time = begin; time <= end; time += interval) {
    watch.note_reading(time);
    watch.note_scan(time);
    watch.note_pose(time, by_imu);
  }
}

TEST(LossWatch, DoubtsAPoseAfterASecondWithoutOne) {
  LossWatch watch;
  track(watch, 0.0, 5.0, 0.1);
  EXPECT_FALSE(watch.is_overdue(5.9));
  EXPECT_TRUE(watch.is_overdue(6.2));
}

TEST(LossWatch, TrustsAnImuForLongerUnlessItPausesToo) {
  LossWatch watch;
  track(watch, 0.0, 5.0, 0.1, true);
  for (double time = 5.0; time < 8.5; time += 0.05) {
    watch.note_reading(time);
  }
  EXPECT_FALSE(watch.is_overdue(7.9));
  EXPECT_TRUE(watch.is_overdue(8.2));
  LossWatch pausing;
  track(pausing, 0.0, 5.0, 0.1, true);
  pausing.note_reading(6.0);
  EXPECT_TRUE(pausing.is_overdue(6.2));
}

TEST(LossWatch, LeavesSlowScannersAlone) {
  LossWatch watch;
  track(watch, 0.0, 30.0, 3.0);
  EXPECT_FALSE(watch.is_overdue(33.0));
  EXPECT_TRUE(watch.is_overdue(50.0));
}

TEST(LossWatch, TakesAPauseForNoUsualInterval) {
  LossWatch watch;
  track(watch, 0.0, 5.0, 0.1);
  watch.note_scan(65.0);
  watch.note_pose(65.0, false);
  EXPECT_TRUE(watch.is_overdue(66.2));
}

TEST(LossWatch, TellsWhenThePoseWasLost) {
  LossWatch watch;
  track(watch, 100.0, 105.0, 0.1);
  EXPECT_EQ(watch.finding(), "");
  watch.lose();
  EXPECT_EQ(
      watch.finding(), "the pose was lost from 5.0 s to the end, not found again in the prior map");
  track(watch, 112.0, 115.0, 0.1);
  EXPECT_EQ(watch.finding(), "the pose was lost from 5.0 to 12.0 s, found again");
  for (int i = 0; i < 20; ++i) {
    watch.lose();
    watch.note_pose(116.0, false);
  }
  EXPECT_NE(watch.finding().find("; 13 times more, found again"), std::string::npos);
}

}  // namespace
}  // namespace nvm::lio
