// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/sweep_azimuth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nvm::io {
namespace {

constexpr std::size_t kColumns = 400;

/// One beam of a sweep, clockwise.
std::vector<TimedPoint> sweep() {
  std::vector<TimedPoint> points(kColumns);
  for (std::size_t i = 0; i < kColumns; ++i) {
    const double azimuth = -2.0 * M_PI * static_cast<double>(i) / kColumns;
    points[i].x = static_cast<float>(5.0 * std::cos(azimuth));
    points[i].y = static_cast<float>(5.0 * std::sin(azimuth));
  }
  return points;
}

TEST(SweepAzimuth, TellsTheShareOfTheSweep) {
  const std::vector<float> fractions = sweep_fractions(sweep());
  ASSERT_EQ(fractions.size(), kColumns);
  for (std::size_t i = 0; i < kColumns; ++i) {
    EXPECT_NEAR(fractions[i], static_cast<double>(i) / kColumns, 1e-6);
  }
}

TEST(SweepAzimuth, NoPointIsBeforeTheFirst) {
  auto points = sweep();
  std::swap(points[0], points[1]);  // as noise near the sensor does
  const std::vector<float> fractions = sweep_fractions(points);
  ASSERT_EQ(fractions.size(), kColumns);
  EXPECT_EQ(*std::min_element(fractions.begin(), fractions.end()), 0.0F);
  EXPECT_EQ(fractions[1], 0.0F);
  EXPECT_NEAR(fractions[2], 1.0 / kColumns, 1e-6);  // the first stays the beginning
}

TEST(SweepAzimuth, NoneOfPointsInNoOrder) {
  auto points = sweep();
  for (std::size_t i = 0; i < kColumns; ++i) {
    std::swap(points[i], points[(7 * i) % kColumns]);
  }
  EXPECT_TRUE(sweep_fractions(points).empty());
}

}  // namespace
}  // namespace nvm::io
