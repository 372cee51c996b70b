// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/clock_watch.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "lio/analytic_motion.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

struct Clock {
  double late = 0.0, later = 0.0;  ///< at the begin and in the end [s]
  double start = -3.0;             ///< until then the body rests [s]
  bool is_mended = true;
  double hidden = 0.0;  ///< share of what is left that poses hide, which lean on the IMU
  double astray = 0.0;  ///< how far such poses turn to and fro in the first 4 s [rad]
};

/// What is found in 30 s of a turning motion. Poses at 10 Hz are good to 0.05 mrad.
ClockWatch watch(const Clock& clock) {
  constexpr double kDuration = 30.0;  // [s]
  auto generator = test::rng();
  std::normal_distribution<double> noise(0.0, 1.0);
  test::AnalyticMotion motion{clock.start};
  motion.turning = 1.5;
  MotionHistory history;
  ClockWatch clocks;
  for (int i = 0; i < static_cast<int>(100.0 * kDuration); ++i) {
    const double t = 0.01 * i;
    const double late = clock.late + (clock.later - clock.late) * t / kDuration;
    const double left = (1.0 - clock.hidden) * (late - clocks.mended());
    ImuSample reading = motion.imu(t - left);
    reading.time = t;
    reading.gyro += Eigen::Vector3d(0.01, -0.01, 0.02);  // a bias is no offset
    history.add(reading);
    if (i % 10 == 9) {
      Pose pose = motion.pose(t);
      pose.linear() *=
          so3_exp(Eigen::Vector3d(0.0, 0.0, t < 4.0 && i % 20 == 9 ? clock.astray : 0.0));
      pose.linear() *=
          so3_exp(5e-5 * Eigen::Vector3d(noise(generator), noise(generator), noise(generator)));
      history.add(StampedPose{t, pose});
    }
    if (i % 300 == 299) {
      EXPECT_TRUE(clocks.look(history, t - 3.0) || t < clock.start + 4.0);
      if (const auto offset = clocks.offset(); offset && clock.is_mended) {
        clocks.mend(*offset);
        history.clear();
      }
    }
  }
  return clocks;
}

double named_offset(const std::string& finding) {
  const std::size_t begin = finding.find("imu.time_offset=");
  return begin == std::string::npos ? std::nan("") : std::stod(finding.substr(begin + 16));
}

TEST(ClockWatch, FindsMillisecondsBetweenTheClocks) {
  for (const double late : {0.005, -0.01, 0.05, -0.08}) {
    const ClockWatch named = watch({late, late, -3.0, false});
    EXPECT_NEAR(named_offset(named.finding()), -late, 0.0011) << named.finding();
    EXPECT_EQ(named.mended(), 0.0);
    for (const double hidden : {0.0, 0.4}) {
      const ClockWatch mended = watch({late, late, -3.0, true, hidden});
      EXPECT_NEAR(mended.mended(), late, 0.0015) << hidden;
      EXPECT_TRUE(mended.was_late_at_first()) << late << ", " << hidden;
      EXPECT_NEAR(named_offset(mended.finding()), -late, 0.0015) << mended.finding();
    }
  }
}

TEST(ClockWatch, SaysAndMendsNothingOfClocksThatAgreeNorWithoutTurns) {
  for (const Clock& clock : {Clock{}, Clock{2e-4, 2e-4}, Clock{0.05, 0.05, 100.0}}) {
    EXPECT_EQ(watch(clock).finding(), "");
    EXPECT_EQ(watch(clock).mended(), 0.0);
    EXPECT_FALSE(watch(clock).was_late_at_first());
  }
}

TEST(ClockWatch, DoesNotAskPosesThatWentAstrayWhetherItWasLateAtFirst) {
  for (const double late : {0.05, -0.05}) {
    for (const double astray : {0.05, -0.05, 0.1, -0.1}) {
      const ClockWatch clocks = watch({late, late, -3.0, true, 0.0, astray});
      EXPECT_NEAR(clocks.mended(), late, 0.0015) << astray;
      EXPECT_TRUE(clocks.was_late_at_first()) << late << ", " << astray;
    }
  }
}

TEST(ClockWatch, NamesAndFollowsADrift) {
  for (const double hidden : {0.0, 0.4}) {
    const ClockWatch clocks = watch({0.0, 0.03, -3.0, true, hidden});
    EXPECT_THAT(clocks.finding(), ::testing::HasSubstr("clock drifts"));
    EXPECT_NEAR(clocks.mended(), 0.03, 0.004);
    EXPECT_FALSE(clocks.was_late_at_first()) << hidden;
  }
}

}  // namespace
}  // namespace nvm::lio
