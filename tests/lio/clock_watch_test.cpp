// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/clock_watch.hpp"

#include <gmock/gmock.h>

#include "lio/analytic_motion.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

/// What is found in 30 s of a turning motion, its gyroscope's clock being late by `late` [s] at the
/// begin and by `later` in the end; it rests until `start` [s]. Poses at 10 Hz are good to 0.05
/// mrad.
std::string finding(double late, double later, double start = -3.0) {
  constexpr double kDuration = 30.0;  // [s]
  auto generator = test::rng();
  std::normal_distribution<double> noise(0.0, 1.0);
  test::AnalyticMotion motion{start};
  motion.turning = 1.5;
  MotionHistory history;
  ClockWatch clocks;
  for (int i = 0; i < static_cast<int>(100.0 * kDuration); ++i) {
    const double t = 0.01 * i;
    ImuSample reading = motion.imu(t - late - (later - late) * t / kDuration);
    reading.time = t;
    reading.gyro += Eigen::Vector3d(0.01, -0.01, 0.02);  // a bias is no offset
    history.add(reading);
    if (i % 10 == 9) {
      Pose pose = motion.pose(t);
      pose.linear() *=
          so3_exp(5e-5 * Eigen::Vector3d(noise(generator), noise(generator), noise(generator)));
      history.add(StampedPose{t, pose});
    }
    if (i % 300 == 299) {
      clocks.look(history, t - 3.0);
    }
  }
  return clocks.finding();
}

TEST(ClockWatch, FindsMillisecondsBetweenTheClocks) {
  for (const double late : {0.005, -0.01, 0.05, -0.08}) {
    const std::string text = finding(late, late);
    const std::size_t begin = text.find("imu.time_offset=");
    ASSERT_NE(begin, std::string::npos) << late;
    EXPECT_NEAR(std::stod(text.substr(begin + 16)), -late, 0.0011) << text;
  }
}

TEST(ClockWatch, SaysNothingOfClocksThatAgreeNorWithoutTurns) {
  EXPECT_EQ(finding(0.0, 0.0), "");
  EXPECT_EQ(finding(0.001, 0.001), "");
  EXPECT_EQ(finding(0.05, 0.05, 100.0), "");
}

TEST(ClockWatch, NamesADrift) {
  EXPECT_THAT(finding(0.0, 0.03), ::testing::HasSubstr("clock drifts"));
}

}  // namespace
}  // namespace nvm::lio
