// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "statistics.hpp"

#include <gmock/gmock.h>

namespace nvm_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using ::testing::HasSubstr;

nvm::lio::FrameResult tracked() {
  nvm::lio::FrameResult frame;
  frame.status = nvm::lio::FrameStatus::kTracking;
  return frame;
}

TEST(Statistics, AreOkWhileTracking) {
  Statistics statistics;
  EXPECT_EQ(statistics.report({}, 0, "").level, DiagnosticStatus::WARN);  // no scan yet
  statistics.add(tracked(), Statistics::Clock::now());
  statistics.note("for your information", false);
  const DiagnosticStatus status = statistics.report({}, 7, "");
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "tracking");
}

TEST(Statistics, SayWhatIsWorst) {
  Statistics statistics;
  statistics.add(tracked(), Statistics::Clock::now());
  statistics.note("an assumption", true);
  EXPECT_EQ(statistics.report({}, 0, "").message, "an assumption");
  nvm::lio::FrameResult lost = tracked();
  lost.status = nvm::lio::FrameStatus::kLost;
  lost.message = "too little fits";
  statistics.add(lost, Statistics::Clock::now());
  const DiagnosticStatus status = statistics.report({}, 0, "");
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_EQ(status.message, "lost: too little fits");
  EXPECT_EQ(statistics.report({}, 0, "no message on /x").message, "no message on /x");
}

TEST(Statistics, WarnOfDropsOnlyInTheReportAfterThem) {
  Statistics statistics;
  statistics.add(tracked(), Statistics::Clock::now());
  QueueStats queue;
  queue.clouds = 10;
  queue.dropped = 4;
  EXPECT_THAT(statistics.report(queue, 0, "").message, HasSubstr("4 of 10 scans dropped"));
  EXPECT_EQ(statistics.report(queue, 0, "").message, "tracking");
}

TEST(Statistics, WarnOfScansThatCannotBeRead) {
  Statistics statistics;
  statistics.add(tracked(), Statistics::Clock::now());
  statistics.add_bad("has no field 'x'");
  EXPECT_THAT(statistics.report({}, 0, "").message, HasSubstr("no field 'x'"));
}

}  // namespace
}  // namespace nvm_ros
