// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/geometry/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/rng.hpp"

namespace nvm {
namespace {

constexpr double kPi = 3.141592653589793;

Eigen::Vector3f random_unit(std::mt19937_64& rng) {
  std::normal_distribution<float> normal;
  return Eigen::Vector3f(normal(rng), normal(rng), normal(rng)).normalized();
}

TEST(AngleLimit, AdmitsEqualVectorsWhateverTheLimit) {
  std::mt19937_64 rng = test::rng();
  for (int i = 0; i < 10'000; ++i) {
    const Eigen::Vector3f v = random_unit(rng);
    EXPECT_TRUE(AngleLimit(0.0).admits(v, v));
    EXPECT_TRUE(AngleLimit(kPi).admits(v, -v));
    EXPECT_FALSE(AngleLimit(0.99 * kPi).admits(v, -v));
  }
}

TEST(AngleLimit, SeparatesAnglesOneTenthOfADegreeApart) {
  for (double limit = 0.01; limit < kPi - 0.01; limit += 0.01) {
    const Eigen::Vector3f x = Eigen::Vector3f::UnitX();
    const auto turned = [](double angle) {
      return Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>().eval();
    };
    EXPECT_TRUE(AngleLimit(limit).admits(x, turned(limit - 0.00175)));
    EXPECT_FALSE(AngleLimit(limit).admits(x, turned(limit + 0.00175)));
  }
}

TEST(AngleLimit, AdmitsNothingThatIsNotANumber) {
  const Eigen::Vector3f x = Eigen::Vector3f::UnitX();
  const Eigen::Vector3f bad(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
  EXPECT_FALSE(AngleLimit(kPi).admits(x, bad));
}

}  // namespace
}  // namespace nvm
