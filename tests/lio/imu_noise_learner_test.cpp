// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_noise_learner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "support/rng.hpp"

namespace nvm::lio {
namespace {

constexpr ImuNoise kUnknown{0.0, 0.0, 1e-5, 1e-4};
constexpr ImuNoise kTrue{1e-3, 1e-2, 1e-5, 1e-4};

using Signal = std::function<double(double time)>;

// A second of readings at `rate` [Hz] with the true noise on top of `signal`.
ImuNoiseLearner taught(double rate, const Signal& signal, std::mt19937_64& rng) {
  std::normal_distribution<double> gauss;
  const auto noisy = [&](double time, double density) {
    Eigen::Vector3d reading = Eigen::Vector3d::Constant(signal(time));
    for (double& component : reading) {
      component += density * std::sqrt(rate) * gauss(rng);
    }
    return reading;
  };
  ImuNoiseLearner learner;
  for (int i = 0; i < rate; ++i) {
    const double time = 100.0 + i / rate;
    learner.add({time, noisy(time, kTrue.gyro), noisy(time, kTrue.accel)});
  }
  return learner;
}

TEST(ImuNoiseLearner, LearnsWhiteNoiseAtAnyRate) {
  auto rng = test::rng();
  for (const double rate : {100.0, 200.0, 400.0, 1000.0}) {
    const ImuNoiseLearner learner = taught(
        rate, [](double) { return 0.3; }, rng);
    for (const bool at_rest : {false, true}) {
      const ImuNoise noise = learner.complete(kUnknown, at_rest);
      EXPECT_NEAR(noise.gyro / kTrue.gyro, 1.0, at_rest ? 0.35 : 0.2) << rate;
      EXPECT_NEAR(noise.accel / kTrue.accel, 1.0, at_rest ? 0.35 : 0.2) << rate;
    }
  }
}

TEST(ImuNoiseLearner, TakesNoMotionForNoise) {
  auto rng = test::rng();
  const Signal walk = [](double time) { return 0.5 * std::sin(2.0 * 3.14159 * 2.0 * time); };
  const ImuNoise noise = taught(200.0, walk, rng).complete(kUnknown, false);
  EXPECT_NEAR(noise.gyro / kTrue.gyro, 1.0, 0.2);
}

TEST(ImuNoiseLearner, SeesMoreAtRestWhereReadingsAreFiltered) {
  auto rng = test::rng();
  std::normal_distribution<double> gauss;
  ImuNoiseLearner learner;
  Eigen::Vector3d filtered = Eigen::Vector3d::Zero();
  for (int i = 0; i < 400; ++i) {
    for (double& component : filtered) {
      component += 0.2 * (1e-2 * std::sqrt(200.0) * gauss(rng) - component);
    }
    learner.add({i / 200.0, filtered, filtered});
  }
  EXPECT_DOUBLE_EQ(
      learner.complete(kUnknown, true).gyro, 2.0 * learner.complete(kUnknown, false).gyro);
}

TEST(ImuNoiseLearner, KeepsWhatIsGivenAndTheUsualWhereLittleIsKnown) {
  auto rng = test::rng();
  const ImuNoise given{1e-2, 0.2, 1e-5, 1e-4};
  const ImuNoiseLearner learner = taught(
      200.0, [](double) { return 0.0; }, rng);
  EXPECT_EQ(learner.complete(given, true).gyro, given.gyro);
  EXPECT_EQ(learner.complete(given, true).accel, given.accel);
  EXPECT_EQ(ImuNoiseLearner().complete(kUnknown, true).gyro, ImuNoise().gyro);
  EXPECT_EQ(learner.complete(kUnknown, true).gyro_bias, kUnknown.gyro_bias);
}

TEST(ImuNoiseLearner, StaysWithinBounds) {
  ImuNoiseLearner silent;
  ImuNoiseLearner loud;
  auto rng = test::rng();
  std::normal_distribution<double> gauss(0.0, 100.0);
  for (int i = 0; i < 400; ++i) {
    silent.add({i / 200.0, Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones()});
    loud.add({i / 200.0, Eigen::Vector3d::Constant(gauss(rng)), Eigen::Vector3d::Ones()});
  }
  EXPECT_EQ(silent.complete(kUnknown, true).gyro, ImuNoise().gyro);
  EXPECT_EQ(loud.complete(kUnknown, true).gyro, 16.0 * ImuNoise().gyro);
}

TEST(ImuNoiseLearner, CountsNoGapAsNoise) {
  auto rng = test::rng();
  std::normal_distribution<double> gauss;
  ImuNoiseLearner learner;
  for (int i = 0; i < 400; ++i) {
    const double gap = i < 200 ? 0.0 : 3.0;
    const Eigen::Vector3d reading =
        Eigen::Vector3d::Constant((i < 200 ? 0.0 : 5.0) + 1e-3 * std::sqrt(200.0) * gauss(rng));
    learner.add({gap + i / 200.0, reading, reading});
  }
  EXPECT_NEAR(learner.complete(kUnknown, false).gyro, 1e-3, 3e-4);
}

}  // namespace
}  // namespace nvm::lio
