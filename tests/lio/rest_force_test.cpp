// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/rest_force.hpp"

#include <gmock/gmock.h>

#include "lio/analytic_motion.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

using ::testing::HasSubstr;

constexpr double kRestForce = 9.81;

/// After `duration` [s] of a swaying motion with poses that are good to 3 mm, of an accelerometer
/// that feels `share` of gravity at rest.
RestForce weighed(double share, bool is_scale, double duration) {
  auto generator = test::rng();
  std::normal_distribution<double> noise(0.0, 0.003);
  const test::AnalyticMotion motion{-3.0};
  const Eigen::Vector3d bias(0.0, 0.0, (share - 1.0) * kRestForce);
  RestForce rest;
  rest.set({0.0, 0.0, share * kRestForce}, kRestForce);
  MotionHistory history;
  for (int i = 0; i < static_cast<int>(100.0 * duration); ++i) {
    const double t = 0.01 * i;
    ImuSample reading = motion.imu(t);
    reading.accel = is_scale ? Eigen::Vector3d(share * reading.accel) : reading.accel + bias;
    history.add(reading);
    if (i % 10 == 9) {
      Pose pose = motion.pose(t);
      pose.translation() += Eigen::Vector3d(noise(generator), noise(generator), noise(generator));
      history.add(StampedPose{t, pose});
    }
    if (i % 300 == 299 && rest.is_open()) {
      rest.weigh(history, 3.0);
    }
  }
  return rest;
}

TEST(RestForce, OfGravityIsNotWorthAWord) {
  for (const double force : {9.6, 9.81, 10.0}) {
    RestForce rest;
    rest.set({0.0, force, 0.0}, kRestForce);
    EXPECT_FALSE(rest.is_open());
    EXPECT_EQ(rest.finding(1.0), "");
  }
}

TEST(RestForce, IsTakenForABiasUntilMotionDecides) {
  for (const double share : {0.85, 0.9, 1.1, 1.15}) {
    for (const bool is_scale : {false, true}) {
      const RestForce before = weighed(share, is_scale, 0.1);
      EXPECT_FALSE(before.scale());
      EXPECT_THAT(before.finding(2.0), HasSubstr("taken for a bias"));
      const RestForce rest = weighed(share, is_scale, 90.0);
      EXPECT_FALSE(rest.is_open()) << share << is_scale;
      ASSERT_EQ(rest.scale().has_value(), is_scale) << share;
      EXPECT_THAT(rest.finding(1.0), HasSubstr(is_scale ? "its scale is off" : "it has a bias"));
      EXPECT_NEAR(rest.scale().value_or(1.0 / share), 1.0 / share, 1e-12);
    }
  }
}

}  // namespace
}  // namespace nvm::lio
