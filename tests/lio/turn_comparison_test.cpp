// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/turn_comparison.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace nvm::lio {
namespace {

constexpr double kSweepTime = 0.1;  // [s]

/// A walk's swing and a slow turn about z [rad].
double angle(double t) { return 0.05 * std::sin(6.0 * t) + 0.6 * std::sin(0.5 * t); }

double rate(double t) { return 0.3 * std::cos(6.0 * t) + 0.3 * std::cos(0.5 * t); }

// Scans alone tell the middle of a sweep, and take it to turn as from the middle before.
double angle_by_scans(double t) {
  return 1.5 * angle(t - 0.5 * kSweepTime) - 0.5 * angle(t - 1.5 * kSweepTime);
}

/// 12 s at 200 Hz, of a gyroscope that turns by `scale` of the truth.
MotionHistory history_of(double scale) {
  MotionHistory history;
  for (int i = 0; i <= 2400; ++i) {
    const double t = 0.005 * i;
    const Eigen::Vector3d gravity(0.0, 0.0, 9.81);
    history.add(ImuSample{t, {0.0, 0.0, scale * rate(t)}, gravity});
    if (i % 20 == 0 && i > 0 && i < 2400) {
      Pose pose = Pose::Identity();
      pose.linear() =
          Eigen::AngleAxisd(angle_by_scans(t), Eigen::Vector3d::UnitZ()).toRotationMatrix();
      history.add(StampedPose{t, pose});
    }
  }
  return history;
}

TEST(TurnComparison, TakesTheOvershootOfPosesForNoScale) {
  for (const double scale : {1.0, 0.9, 1.2}) {
    const auto turns = compare_turns(history_of(scale));
    ASSERT_TRUE(turns);
    EXPECT_NEAR(scale * turns->scale_of_changes, 1.0, 0.04) << scale;  // less than is mended
    EXPECT_LT(turns->scale_deviation, 0.02) << scale;
  }
}

TEST(TurnComparison, OfFewTurnsTellsNoScaleOfChanges) {
  MotionHistory history = history_of(1.2);
  MotionHistory few;
  for (const ImuSample& reading : history.readings(0.0, 2.9)) {
    few.add(reading);
  }
  for (const StampedPose& pose : history.poses(12.0)) {
    if (pose.time < 2.9) {
      few.add(pose);
    }
  }
  const auto turns = compare_turns(few);
  ASSERT_TRUE(turns);
  EXPECT_EQ(turns->scale_deviation, 1.0);
}

}  // namespace
}  // namespace nvm::lio
