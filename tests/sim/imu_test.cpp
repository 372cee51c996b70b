// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/imu.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/angles.hpp"

namespace nvm::sim {
namespace {

Route long_route() {
  Route route;
  route.waypoints = {{0, 0, 0}, {8, 0, 0}, {8, 5, 0}, {0, 5, 0}, {0, 0, 0}, {8, 0, 0}};
  return route;
}

ImuOptions perfect() {
  ImuOptions options;
  options.gyro = {};
  options.accelerometer = {};
  return options;
}

/// Integrates readings from the true state at `begin` to `end`, by the midpoint of neighbours.
Eigen::Vector3d dead_reckon(
    const std::vector<ImuSample>& imu, const Motion& motion, double begin, double end) {
  const Kinematics start = motion.kinematics(begin);
  Eigen::Matrix3d R = start.T_world_imu.linear();
  Eigen::Vector3d v = start.velocity;
  Eigen::Vector3d p = start.T_world_imu.translation();
  const Eigen::Vector3d gravity(0.0, 0.0, -9.81);
  for (std::size_t i = 0; i + 1 < imu.size(); ++i) {
    if (imu[i].time < begin - 1e-9 || imu[i + 1].time > end + 1e-9) {
      continue;
    }
    const double dt = imu[i + 1].time - imu[i].time;
    const Eigen::Matrix3d R_next = R * so3_exp(0.5 * dt * (imu[i].gyro + imu[i + 1].gyro));
    const Eigen::Vector3d a = 0.5 * (R * imu[i].accel + R_next * imu[i + 1].accel) + gravity;
    p += dt * v + 0.5 * dt * dt * a;
    v += dt * a;
    R = R_next;
  }
  return p;
}

TEST(Imu, DeadReckoningWithoutNoiseStaysWithinACentimetreFor10Seconds) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Motion motion(long_route(), {}, seed, 30.0);
    const auto imu = simulate_imu(motion, perfect(), seed);
    for (const double begin : {1.0, 8.0, 15.0}) {
      const Eigen::Vector3d p = dead_reckon(imu, motion, begin, begin + 10.0);
      EXPECT_LT((p - motion.pose(begin + 10.0).translation()).norm(), 0.01);
    }
  }
}

TEST(Imu, ShowsGravityAtRest) {
  const Motion motion(long_route(), {}, 4, 10.0);
  const auto imu = simulate_imu(motion, perfect(), 4);
  const Eigen::Vector3d up = motion.pose(0.0).linear().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((imu[10].accel - 9.81 * up).norm(), 1e-12);
  EXPECT_LT(imu[10].gyro.norm(), 1e-12);
}

TEST(Imu, SamplesTheWholeMotionAtItsRate) {
  const Motion motion(long_route(), {}, 1, 10.0);
  ImuOptions options;
  options.rate = 250.0;
  const auto imu = simulate_imu(motion, options, 1);
  ASSERT_EQ(imu.size(), 2501U);
  EXPECT_DOUBLE_EQ(imu.front().time, 0.0);
  EXPECT_DOUBLE_EQ(imu.back().time, 10.0);
}

/// Gyro readings at rest, where they are bias and noise alone.
std::vector<Eigen::Vector3d> errors_at_rest(const ImuOptions& options, std::uint64_t seed) {
  MotionOptions still;
  still.still_time = 60.0;
  const Motion motion(long_route(), still, seed, 60.0);
  std::vector<Eigen::Vector3d> errors;
  for (const ImuSample& sample : simulate_imu(motion, options, seed)) {
    errors.push_back(sample.gyro);
  }
  return errors;
}

TEST(Imu, WhiteNoiseHasItsDensity) {
  ImuOptions options = perfect();
  options.gyro.noise_density = 0.003;
  double sum = 0.0;
  const auto errors = errors_at_rest(options, 5);
  for (const Eigen::Vector3d& error : errors) {
    sum += error.squaredNorm() / 3.0;
  }
  const double sigma = std::sqrt(sum / static_cast<double>(errors.size()));
  EXPECT_NEAR(sigma, 0.003 * std::sqrt(options.rate), 0.02 * sigma);
}

TEST(Imu, BiasStartsAndWalksAsConfigured) {
  ImuOptions options = perfect();
  options.rate = 20.0;
  options.gyro.initial_bias = 0.01;
  options.gyro.bias_walk = 0.002;
  double sq_start = 0.0;
  double sq_walk = 0.0;
  constexpr int kSeeds = 60;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto errors = errors_at_rest(options, seed);
    sq_start += errors.front().squaredNorm() / (3.0 * kSeeds);
    sq_walk += (errors.back() - errors.front()).squaredNorm() / (3.0 * kSeeds);
  }
  EXPECT_NEAR(std::sqrt(sq_start), 0.01, 0.002);
  EXPECT_NEAR(std::sqrt(sq_walk), 0.002 * std::sqrt(60.0), 0.003);
}

TEST(Imu, ScaleAndMisalignmentDistortTheReadings) {
  ImuOptions options = perfect();
  const Motion motion(long_route(), {}, 2, 12.0);
  const auto truth = simulate_imu(motion, options, 2);
  options.gyro.scale_error = 0.01;
  options.accelerometer.misalignment_deg = 1.0;
  const auto distorted = simulate_imu(motion, options, 2);
  const std::size_t i = 1800;
  EXPECT_GT((distorted[i].gyro - truth[i].gyro).norm(), 1e-5);
  EXPECT_LT((distorted[i].gyro - truth[i].gyro).norm(), 0.05 * truth[i].gyro.norm());
  EXPECT_NEAR(distorted[i].accel.norm(), truth[i].accel.norm(), 1e-9);
  EXPECT_GT((distorted[i].accel - truth[i].accel).norm(), 1e-3);
}

TEST(Imu, GradeScalesAllErrors) {
  ImuOptions options;
  options.gyro.scale_error = 0.0;
  const auto good = errors_at_rest(options, 3);
  options.grade = 4.0;
  const auto poor = errors_at_rest(options, 3);
  ASSERT_EQ(good.size(), poor.size());
  for (std::size_t i = 0; i < good.size(); i += 97) {
    EXPECT_LT((poor[i] - 4.0 * good[i]).norm(), 1e-12);
  }
}

TEST(Imu, VibratesAtItsFrequencyAndAmplitude) {
  ImuOptions options = perfect();
  options.rate = 1000.0;
  options.vibration_frequency = 50.0;
  options.gyro.vibration = 0.2;
  const auto errors = errors_at_rest(options, 3);
  EXPECT_NEAR(errors[5].norm(), 0.2, 1e-9);  // a quarter of the 20 ms
  EXPECT_LT(errors[10].norm(), 1e-9);
  EXPECT_LT((errors[5] + errors[15]).norm(), 1e-9);
}

TEST(Imu, ClockIsLateAndUnsteadyButKeepsTheOrder) {
  const Motion motion(long_route(), {}, 1, 10.0);
  ImuOptions options;
  const auto exact = simulate_imu(motion, options, 1);
  options.clock_offset = -0.02;
  options.clock_jitter = 0.004;
  const auto late = simulate_imu(motion, options, 1);
  ASSERT_EQ(late.size(), exact.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < late.size(); ++i) {
    mean += (late[i].time - exact[i].time) / static_cast<double>(late.size());
    EXPECT_EQ(late[i].gyro, exact[i].gyro);
    if (i > 0) {
      ASSERT_GT(late[i].time, late[i - 1].time);
    }
  }
  EXPECT_NEAR(mean, -0.02, 0.001);
}

}  // namespace
}  // namespace nvm::sim
