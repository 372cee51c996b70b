// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <random>
#include <vector>

#include "nvm/normal/normal_estimator.hpp"
#include "support/furnished_room.hpp"

namespace nvm {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline test::TrueScan room_scan(std::mt19937_64& rng, double noise = 0.01) {
  return test::FurnishedRoom(7.0, rng).scan(test::spinning_directions(16, 500), noise, rng);
}

// A square of 1 m across the x axis at x = `range`, a point every 5 cm.
inline std::vector<Eigen::Vector3d> wall(double range) {
  std::vector<Eigen::Vector3d> points;
  for (int y = -10; y <= 10; ++y) {
    for (int z = -10; z <= 10; ++z) {
      points.emplace_back(range, 0.05 * y, 0.05 * z);
    }
  }
  return points;
}

inline NormalOptions fixed_radius(double radius) {
  NormalOptions options;
  options.min_radius = options.max_radius = radius;
  return options;
}

inline void expect_same_bits(const NormalResult& a, const NormalResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.normals, b.normals);
}

}  // namespace nvm
