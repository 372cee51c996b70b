// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "normal/scans.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TEST(Widening, HappensOnlyWhereTheNeighborsAreALineOrTooFew) {
  std::mt19937_64 rng = test::rng();
  const test::TrueScan scan = room_scan(rng);
  const Vector3d viewpoint(0, 0, 0);
  const NormalResult narrow = estimate_normals(scan.points, viewpoint, fixed_radius(0.1));
  const NormalResult wide = estimate_normals(scan.points, viewpoint, fixed_radius(0.2));
  NormalOptions both = fixed_radius(0.1);
  both.widening = 2.0;
  const NormalResult widened = estimate_normals(scan.points, viewpoint, both);
  std::size_t gained = 0, differ = 0;  // they may differ where a threshold is met to the last bits
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const bool is_thin = narrow.status[i] == NormalStatus::kLineLike ||
                         narrow.status[i] == NormalStatus::kFewNeighbors;
    const NormalResult& expected = is_thin ? wide : narrow;
    gained += is_thin && widened.status[i] == NormalStatus::kValid ? 1U : 0U;
    if (widened.status[i] != expected.status[i]) {
      ++differ;
    } else {
      EXPECT_LT((widened.normals[i] - expected.normals[i]).norm(), 1e-2F);
    }
  }
  EXPECT_GT(gained, 100U);
  EXPECT_LE(differ, 2U);
}

// As a LiDAR with few beams draws them: 0.3 m apart, a point every 2 cm.
TEST(Widening, IsNeededByRingsOnAFloor) {
  std::vector<Vector3d> points;
  for (int ring = 0; ring < 5; ++ring) {
    for (int i = -100; i <= 100; ++i) {
      points.emplace_back(4.0 + 0.3 * ring, 0.02 * i, -1.3);
    }
  }
  NormalOptions option = fixed_radius(0.2);
  EXPECT_EQ(estimate_normals(points, Vector3d(0, 0, 0), option).stats.valid, 0U);
  option.widening = 2.0;
  const NormalResult widened = estimate_normals(points, Vector3d(0, 0, 0), option);
  EXPECT_EQ(widened.stats.valid, points.size());
  for (const Vector3f& normal : widened.normals) {
    EXPECT_LT((normal - Vector3f::UnitZ()).norm(), 1e-3F);
  }
}
}  // namespace
}  // namespace nvm
