// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/range_scale.hpp"

#include <gmock/gmock.h>

#include <string>

#include "lio/analytic_motion.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

using ::testing::StartsWith;

constexpr double kGravity = 9.81;

/// After a minute of a swaying motion that scans with ranges `factor` times too long tell to 3 mm,
/// beside an accelerometer that reads `share` of what it feels.
std::string finding(double factor, double share) {
  auto generator = test::rng();
  std::normal_distribution<double> noise(0.0, 0.003);
  const test::AnalyticMotion motion{-3.0};
  RangeScale ranges;
  MotionHistory history;
  for (int i = 0; i < 6000; ++i) {
    const double t = 0.01 * i;
    ImuSample reading = motion.imu(t);
    reading.accel *= share;
    history.add(reading);
    if (i % 10 == 9) {
      Pose pose = motion.pose(t);
      pose.translation() = factor * pose.translation() +
                           Eigen::Vector3d(noise(generator), noise(generator), noise(generator));
      history.add(StampedPose{t, pose});
    }
    if (i % 300 == 299) {
      ranges.weigh(history, 3.0, kGravity);
    }
  }
  return ranges.finding();
}

TEST(RangeScale, NamesTheFactorOfRangesThatAreNotInMetres) {
  const std::string begin = "the scans tell ";
  for (const double factor : {3.2808, 0.3048, 1.2}) {
    const std::string line = finding(factor, 1.0);
    ASSERT_THAT(line, StartsWith(begin)) << factor;
    EXPECT_NEAR(std::stod(line.substr(begin.size())), factor, 0.05 * factor);
  }
}

TEST(RangeScale, IsSilentOfMetresAndOfAnAccelerometerThatIsOff) {
  EXPECT_EQ(finding(1.0, 1.0), "");
  EXPECT_EQ(finding(1.02, 1.0), "");
  EXPECT_EQ(finding(1.0, 1.2), "");
  EXPECT_EQ(RangeScale().finding(), "");
}

}  // namespace
}  // namespace nvm::lio
