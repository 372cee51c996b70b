// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_clipping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/rng.hpp"

namespace nvm::lio {
namespace {

/// 20 s of a swaying and noisy sensor at 200 Hz, up to about 3 about y; changed by `change`.
template <class Change>
ImuClipping clipping_of(const Change& change) {
  auto generator = test::rng();
  std::normal_distribution<double> noise(0.0, 0.05);
  ImuClipping clipping;
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.005 * i;
    const Eigen::Vector3d reading(
        std::sin(3.0 * t) + noise(generator),
        3.0 * std::sin(2.0 * t) + noise(generator),
        0.5 + noise(generator));
    clipping.add(change(reading));
  }
  return clipping;
}

TEST(ImuClipping, FindsTheAxisThatIsCutOffAndWhere) {
  const auto clipped = clipping_of([](const Eigen::Vector3d& reading) {
                         return Eigen::Vector3d(reading.cwiseMax(-2.0).cwiseMin(2.0));
                       }).clipped();
  ASSERT_TRUE(clipped);
  EXPECT_EQ(clipped->index, 1);
  EXPECT_EQ(clipped->limit, 2.0);
  EXPECT_NEAR(clipped->share, 0.53, 0.06);  // 1 - 2 asin(2 / 3) / pi
}

TEST(ImuClipping, IsNotSeenInSoundReadings) {
  const auto sound = [](const Eigen::Vector3d& reading) { return reading; };
  EXPECT_FALSE(clipping_of(sound).clipped());
  for (const double step : {0.001, 0.05, 0.5}) {
    const auto coarse = [step](const Eigen::Vector3d& reading) {
      return Eigen::Vector3d(step * (reading / step).array().round());
    };
    EXPECT_FALSE(clipping_of(coarse).clipped()) << step;
  }
}

TEST(ImuClipping, IsNotSeenInReadingsThatAreSentSeveralTimes) {
  int count = 0;
  Eigen::Vector3d held;
  const auto repeat = [&](const Eigen::Vector3d& reading) {
    held = count++ % 5 == 0 ? reading : held;
    return held;
  };
  EXPECT_FALSE(clipping_of(repeat).clipped());
}

TEST(ImuClipping, SeesAnAxisThatNeverLeavesItsLimit) {
  ImuClipping clipping = clipping_of([](const Eigen::Vector3d& reading) {
    return Eigen::Vector3d(reading.x(), reading.y(), std::min(reading.z(), 0.2));
  });
  ASSERT_TRUE(clipping.stuck());
  EXPECT_EQ(clipping.stuck()->index, 2);
  EXPECT_FALSE(clipping_of([](const Eigen::Vector3d& reading) { return reading; }).stuck());
}

TEST(ImuClipping, SeesAnAxisThatStandsStill) {
  for (const double value : {0.0, 0.3, -9.81}) {
    int count = 0;
    const auto frozen = clipping_of([&](const Eigen::Vector3d& reading) {
                          const bool is_dead = ++count > 1000;  // of 4000
                          return Eigen::Vector3d(reading.x(), is_dead ? value : reading.y(), 0.5);
                        }).frozen();
    ASSERT_TRUE(frozen) << value;
    EXPECT_EQ(frozen->index, 1);
    EXPECT_EQ(frozen->limit, value);
    EXPECT_NEAR(frozen->share, 0.75, 0.001);
  }
}

TEST(ImuClipping, SeesNoneThatMovesOrRestsWithTheOthers) {
  EXPECT_FALSE(clipping_of([](const Eigen::Vector3d& reading) { return reading; }).frozen());
  EXPECT_FALSE(
      clipping_of([](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 9.8); }).frozen());
  int count = 0;
  const auto seldom = [&](const Eigen::Vector3d& reading) {
    return ++count % 300 == 0 ? reading : Eigen::Vector3d(reading.x(), 0.1, 0.2);
  };
  EXPECT_FALSE(clipping_of(seldom).frozen());
}

}  // namespace
}  // namespace nvm::lio
