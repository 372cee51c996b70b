// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/imu_gap_monitor.hpp"

#include <gmock/gmock.h>

namespace nvm::io {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// `bursts` of `size` readings, `within` [s] apart, one burst every `period` [s]; `pause` [s] after
// burst 50.
std::string summary(int bursts, int size, double within, double period, double pause = 0.0) {
  ImuGapMonitor monitor;
  for (int burst = 0; burst < bursts; ++burst) {
    for (int i = 0; i < size; ++i) {
      monitor.add(10.0 + burst * period + i * within + (burst > 50 ? pause : 0.0));
    }
  }
  return monitor.summary().value_or("");
}

TEST(ImuGapMonitor, EvenReadingsHaveNoGaps) { EXPECT_EQ(summary(1000, 1, 0.0, 0.005), ""); }

TEST(ImuGapMonitor, CountsGapsAndNamesTheLongest) {
  EXPECT_EQ(
      summary(1000, 1, 0.0, 0.005, 0.5),
      "the IMU has 1 gaps of more than 0.020 s, the longest of 0.505 s at t = 10.250 s");
}

TEST(ImuGapMonitor, BurstsAreNamedAndTheirPausesAreNoGaps) {
  for (const int size : {2, 5, 10, 30}) {
    const std::string text = summary(100, size, 1e-4, 0.005 * size);
    EXPECT_THAT(text, HasSubstr("come in bursts, 0.000100 s apart")) << size;
    EXPECT_THAT(text, Not(HasSubstr("gaps"))) << size;
  }
}

TEST(ImuGapMonitor, AGapBetweenBurstsIsCounted) {
  EXPECT_THAT(
      summary(100, 10, 1e-4, 0.05, 0.5), HasSubstr("; the IMU has 1 gaps of more than 0.196 s"));
}

}  // namespace
}  // namespace nvm::io
