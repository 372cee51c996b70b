// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_summary.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "app/failure.hpp"
#include "app/run_verdict.hpp"

namespace nvm::app {
namespace {

using lio::FrameResult;
using lio::FrameStatus;

// Frames a tenth of a second apart, of the statuses that letters stand for: t, w, l, i; T: tracking
// with two directions open.
RunSummary summary_of(const std::string& letters) {
  RunSummary summary;
  for (const char letter : letters) {
    FrameResult frame;
    frame.time = 1.7e9 + 0.1 * static_cast<double>(summary.frames());
    frame.status = letter == 'w'   ? FrameStatus::kWeak
                   : letter == 'l' ? FrameStatus::kLost
                   : letter == 'i' ? FrameStatus::kInitializing
                   : letter == 'd' ? FrameStatus::kDegenerate
                                   : FrameStatus::kTracking;
    frame.degenerate_directions = letter == 'T' || letter == 'd' ? 2 : 0;
    frame.message = letter == 't' ? "" : "why";
    summary.add(frame, frame.points);
  }
  return summary;
}

TEST(RunSummaryTest, NamesTheSecondsOfTheRun) {
  EXPECT_THAT(
      summary_of("ittwwwtttdddTlt").warnings(),
      ::testing::ElementsAre(
          "3 of 15 scans weak (their poses are predictions): 0.3 to 0.5 s; why",
          "1 of 15 scans lost (they have no pose): at 1.3 s; why",
          ::testing::AllOf(
              ::testing::HasSubstr("3 of 15 scans degenerate: for too long"),
              ::testing::EndsWith(": 0.9 to 1.1 s"))));
}

TEST(RunSummaryTest, NamesTheDirectionsThatScansDoNotTell) {
  RunSummary summary;
  FrameResult frame;
  frame.status = FrameStatus::kDegenerate;
  frame.degenerate_directions = 2;
  for (const double sign : {1.0, -1.0, 1.0}) {
    frame.unobserved.translations = {sign * Eigen::Vector3d(0.6, -0.8, 0.0)};
    frame.unobserved.rotations = {sign * Eigen::Vector3d::UnitZ()};
    summary.add(frame, frame.points);
    frame.time += 0.1;
  }
  EXPECT_THAT(
      summary.warnings(),
      ::testing::ElementsAre(::testing::HasSubstr(
          "drifts, mostly along (-0.60, 0.80, 0.00), turning about (0.00, 0.00, 1.00)): 0.0 to")));
}

TEST(RunSummaryTest, TellsTheLongestTimesOfMany) {
  const std::vector<std::string> warnings = summary_of("wtwwwtwtwwwwwtwtwwtwwwwtt").warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(
      warnings[0],
      ::testing::HasSubstr("0.2 to 0.4 s, 0.8 to 1.2 s, 1.6 to 1.7 s, 1.9 to 2.2 s and 3 shorter"));
}

TEST(RunSummaryTest, NamesTheLongestPauseBetweenScans) {
  const auto with_pause = [](double pause) {
    RunSummary summary;
    FrameResult frame;
    frame.status = FrameStatus::kTracking;
    for (int i = 0; i < 40; ++i) {
      frame.time = 1.7e9 + 0.1 * i + (i < 12 ? 0.0 : pause);
      summary.add(frame, 0);
    }
    return summary.warnings();
  };
  EXPECT_TRUE(with_pause(0.3).empty());  // a few dropped scans
  EXPECT_THAT(
      with_pause(1.4),
      ::testing::ElementsAre(::testing::HasSubstr("no scan came for 1.5 s after 1.1 s")));
}

TEST(RunSummaryTest, NamesReturnsThatAreAlmostAllOutOfRange) {
  const auto with_points = [](std::size_t points, FrameStatus status) {
    RunSummary summary(2000);
    FrameResult frame;
    frame.status = status;
    frame.points = points;
    summary.add(frame, 5000);  // which would be thinned to 2000
    return summary.warnings();
  };
  EXPECT_TRUE(with_points(600, FrameStatus::kTracking).empty());
  EXPECT_THAT(
      with_points(100, FrameStatus::kTracking),
      ::testing::ElementsAre(::testing::StartsWith("95 % of the returns lie nearer than")));
  EXPECT_THAT(
      with_points(0, FrameStatus::kInitializing),  // which counts no points
      ::testing::ElementsAre(::testing::HasSubstr("initializing")));
}

// Whatever the first scans wait for, what most of them lack is the reason that none got a pose.
TEST(RunSummaryTest, NamesTheUsualTroubleOfARunWithoutAPose) {
  RunSummary summary;
  FrameResult frame;
  for (int i = 0; i < 30; ++i) {
    frame.time = 0.1 * i;
    frame.message = i < 10 ? "waits" : lio::kTooFewSurfaces;
    summary.add(frame, 5000);
  }
  EXPECT_THAT(
      summary.main_trouble(),
      ::testing::AllOf(
          ::testing::HasSubstr(lio::kTooFewSurfaces),
          ::testing::HasSubstr("100 % of the returns"),
          ::testing::Not(::testing::HasSubstr("waits"))));
}

TEST(RunVerdictTest, AMapOfNextToNoPointsIsNotUsable) {
  const RunSummary summary = summary_of("ttttt");
  EXPECT_NO_THROW(check_usable(summary, 5, "out"));
  try {
    check_usable(summary, 4, "out");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.status(), kExitUnusable);
    EXPECT_THAT(failure.what(), ::testing::HasSubstr("4 points after 5 poses"));
  }
}

TEST(RunSummaryTest, TheMainTroubleIsThatOfMostFrames) {
  EXPECT_THAT(summary_of("iitwwwl").main_trouble(), ::testing::StartsWith("3 of 7 scans weak"));
  EXPECT_EQ(summary_of("ttt").main_trouble(), "");
}

TEST(RunSummaryTest, UsableFramesDoNotSlideForLong) {
  EXPECT_EQ(summary_of("iitttTddwl").usable(), 4U);
  EXPECT_EQ(summary_of("iitttTddwl").counts(), "2 initializing, 1 weak, 1 lost, 2 degenerate");
}

TEST(RunSummaryTest, WarnsOfPointsThatAreNotInTheMap) {
  RunSummary summary;
  FrameResult frame;
  frame.status = FrameStatus::kTracking;
  frame.points = 100;
  frame.inserted.out_of_range = 70;
  frame.inserted.no_normal = 30;
  summary.add(frame, frame.points);
  summary.add(frame, frame.points);
  EXPECT_THAT(summary.warnings(), ::testing::ElementsAre(::testing::StartsWith("140 points")));
  EXPECT_THAT(summary.inserted().why_empty(), ::testing::StartsWith("140 of 200 returns lie more"));
  frame.inserted.no_normal = 1000;
  summary.add(frame, frame.points);
  EXPECT_THAT(summary.inserted().why_empty(), ::testing::HasSubstr("no surface"));
  EXPECT_THAT(InsertTotals().why_empty(), ::testing::HasSubstr("lidar.min_range"));
}

}  // namespace
}  // namespace nvm::app
