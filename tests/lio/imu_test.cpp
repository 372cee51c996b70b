// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <limits>

#include "lio/analytic_motion.hpp"
#include "lio/imu/imu_buffer.hpp"
#include "lio/imu/imu_initializer.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

ImuSample sample(double time, double value = 0.0) {
  return {time, Eigen::Vector3d::Constant(value), Eigen::Vector3d::Constant(-value)};
}

std::vector<double> times(const std::vector<ImuSample>& samples) {
  std::vector<double> result;
  for (const ImuSample& s : samples) {
    result.push_back(s.time);
  }
  return result;
}

TEST(ImuBuffer, InterpolatesASampleAtEachBorder) {
  ImuBuffer buffer;
  for (int i = 0; i <= 4; ++i) {
    buffer.add(sample(i, 10.0 * i));
  }
  std::vector<ImuSample> found;
  buffer.between(0.5, 3.25, 1.5, found);
  EXPECT_THAT(times(found), ::testing::ElementsAre(0.5, 1.0, 2.0, 3.0, 3.25));
  EXPECT_DOUBLE_EQ(found.front().gyro.x(), 5.0);
  EXPECT_DOUBLE_EQ(found.back().gyro.x(), 32.5);
  EXPECT_DOUBLE_EQ(found.back().accel.x(), -32.5);
}

TEST(ImuBuffer, RepeatsTheNearestReadingOnlyWithinTheGap) {
  ImuBuffer buffer;
  buffer.add(sample(1.0, 1.0));
  buffer.add(sample(2.0, 2.0));
  std::vector<ImuSample> found;
  buffer.between(0.9, 2.1, 0.2, found);
  EXPECT_THAT(times(found), ::testing::ElementsAre(0.9, 1.0, 2.0, 2.1));
  buffer.between(0.0, 3.0, 0.2, found);
  EXPECT_THAT(times(found), ::testing::ElementsAre(1.0, 2.0));
  buffer.between(1.4, 1.6, 0.2, found);
  EXPECT_TRUE(found.empty());
}

TEST(ImuBuffer, SortsWhatComesOutOfOrder) {
  ImuBuffer buffer;
  for (const double time : {3.0, 1.0, 2.0, 2.0}) {
    buffer.add(sample(time));
  }
  std::vector<ImuSample> found;
  buffer.between(1.0, 3.0, 1.5, found);
  EXPECT_THAT(times(found), ::testing::ElementsAre(1.0, 2.0, 3.0));
  EXPECT_EQ(buffer.stats().repeated, 1U);
}

TEST(ImuBuffer, CountsAndDropsWhatIsLateOrNotFinite) {
  ImuBuffer buffer;
  buffer.add(sample(1.0));
  buffer.use_until(1.5);
  buffer.add(sample(1.2));
  buffer.add(sample(std::numeric_limits<double>::quiet_NaN()));
  buffer.add(sample(2.0, std::numeric_limits<double>::infinity()));
  EXPECT_EQ(buffer.stats().accepted, 1U);
  EXPECT_EQ(buffer.stats().late, 1U);
  EXPECT_EQ(buffer.stats().non_finite, 2U);
}

TEST(ImuBuffer, MovesItsReadingsAndTakesThoseThatFollow) {
  for (const double by : {0.3, -0.3}) {
    ImuBuffer buffer;
    for (int i = 0; i <= 4; ++i) {
      buffer.add(sample(i));
    }
    buffer.use_until(2.0);
    buffer.move(by);
    buffer.add(sample(5.0 + by));
    buffer.add(sample(1.9 + by));
    EXPECT_EQ(buffer.stats().late, 1U);
    std::vector<ImuSample> found;
    buffer.between(2.0 + by, 5.0 + by, 1.5, found);
    EXPECT_THAT(times(found), ::testing::ElementsAre(2.0 + by, 3.0 + by, 4.0 + by, 5.0 + by));
  }
}

TEST(ImuBuffer, KnowsTheUsualIntervalOfItsStream) {
  ImuBuffer buffer;
  EXPECT_EQ(buffer.interval(), 0.0);
  for (int i = 0; i < 30; ++i) {
    buffer.add(sample(i == 29 ? 9.0 : 0.05 * i));
  }
  EXPECT_NEAR(buffer.interval(), 0.05, 1e-9);
}

TEST(ImuInitializer, FindsTiltAndGyroBiasAtRest) {
  auto generator = test::rng();
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto vector = [&] {
    return Eigen::Vector3d(noise(generator), noise(generator), noise(generator));
  };
  const Eigen::Vector3d bias(0.01, -0.02, 0.005);
  const Eigen::Matrix3d R_world_body = so3_exp({0.2, -0.3, 0.0});
  ImuInitializer initializer({});
  for (int i = 0; i <= 240; ++i) {
    initializer.add(
        {0.005 * i,
         bias + 0.002 * vector(),
         R_world_body.transpose() * Eigen::Vector3d(0.0, 0.0, 9.81) + 0.02 * vector()});
  }
  const auto initial = initializer.state();
  ASSERT_TRUE(initial);
  EXPECT_LT((initial->state.gyro_bias - bias).norm(), 1e-3);
  const Eigen::Vector3d up =
      initial->state.T_world_body.linear() * (R_world_body.transpose().col(2));
  EXPECT_LT((up - Eigen::Vector3d::UnitZ()).norm(), 1e-3);
}

TEST(ImuInitializer, RefusesAMovingSensorWithAReason) {
  InitializerOptions options;
  options.moving_start_after = -1.0;
  ImuInitializer initializer(options);
  const test::AnalyticMotion motion{-10.0};
  for (int i = 0; i < 1000; ++i) {
    initializer.add(motion.imu(0.005 * i));
  }
  EXPECT_FALSE(initializer.state());
  EXPECT_THAT(
      initializer.why_not(), ::testing::HasSubstr("the sensor moves: keep it still for 1 s"));
}

// What is white noise, and what is motion, does not depend on the grade of the IMU.
TEST(ImuInitializer, TellsNoiseFromMotion) {
  auto generator = test::rng();
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    return Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
  };
  for (const double swing : {0.0, 0.1}) {  // [rad/s], at 1.5 Hz
    std::vector<ImuSample> readings;
    for (int i = 0; i <= 200; ++i) {
      const double t = 0.005 * i;
      const Eigen::Vector3d rate(0.0, swing * std::sin(3.0 * M_PI * t), 0.0);
      readings.push_back(
          {t, rate + 0.04 * vector(), Eigen::Vector3d(0.0, 0.0, 9.81) + 0.4 * vector()});
    }
    EXPECT_EQ(judge_stillness(readings, {}).still, swing == 0.0);
  }
}

TEST(ImuInitializer, TakesSlowReadingsAsTheyAre) {
  std::vector<ImuSample> readings;
  for (int i = 0; i <= 20; ++i) {  // swings of 5 Hz, which 20 Hz only just show
    readings.push_back({0.05 * i, {0.1 * std::sin(0.5 * M_PI * i), 0.0, 0.0}, {0.0, 0.0, 9.81}});
  }
  EXPECT_FALSE(judge_stillness(readings, {}).still);
}

TEST(ImuInitializer, KnowsWhichWayIsUpWhileMoving) {
  ImuInitializer initializer({});
  const test::AnalyticMotion motion{-10.0};
  for (int i = 0; i <= 200; ++i) {
    initializer.add(motion.imu(0.005 * i));
  }
  EXPECT_FALSE(initializer.state());
  EXPECT_TRUE(initializer.is_hopeless());
  const Eigen::Vector3d up = initializer.level() * motion.pose(1.0).linear().transpose().col(2);
  EXPECT_LT((up - Eigen::Vector3d::UnitZ()).norm(), 0.15);
}

TEST(ImuInitializer, RefusesARestWithoutGravity) {
  for (const double force : {0.0, 0.1, 4.0, 20.0}) {
    ImuInitializer initializer({});
    for (int i = 0; i <= 250; ++i) {
      initializer.add({0.005 * i, Eigen::Vector3d::Zero(), {0.0, 0.0, force}});
    }
    EXPECT_FALSE(initializer.state()) << force;
    EXPECT_TRUE(initializer.is_hopeless()) << force;
    EXPECT_THAT(initializer.why_not(), ::testing::HasSubstr("at rest, not 9.81")) << force;
  }
}

TEST(ImuInitializer, RejectsBadOptions) {
  InitializerOptions options;
  options.still_duration = 0.0;
  EXPECT_THROW(ImuInitializer{options}, std::invalid_argument);
}

}  // namespace
}  // namespace nvm::lio
