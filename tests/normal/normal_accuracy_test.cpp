// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// The default options against the truth, on rooms that were not used to choose them.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <random>

#include "nvm/normal/normal_estimator.hpp"
#include "support/furnished_room.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

constexpr double kRoomSizes[] = {4.5, 6.0, 8.0, 10.0, 12.0};  // [m]

struct Accuracy {
  std::size_t points = 0, valid = 0, within = 0;

  void add(const test::TrueScan& scan, const NormalResult& result, double limit_deg) {
    const auto min_cosine = static_cast<float>(std::cos(limit_deg * 0.017453292519943295));
    points += scan.points.size();
    valid += result.stats.valid;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      within += result.normals[i].dot(scan.normals[i]) >= min_cosine ? 1U : 0U;
    }
  }
  double valid_share() const { return static_cast<double>(valid) / static_cast<double>(points); }
  double within_share() const { return static_cast<double>(within) / static_cast<double>(valid); }
};

TEST(NormalAccuracy, OfASpinningSensorIsWithinTenDegreesForNineInTen) {
  std::mt19937_64 rng = test::rng();
  NormalEstimator estimator;
  Accuracy accuracy;
  for (const double size : kRoomSizes) {
    const test::FurnishedRoom room(size, rng);
    const test::TrueScan scan = room.scan(test::spinning_directions(16, 1500), 0.01, rng);
    accuracy.add(scan, estimator.estimate(scan.points, Eigen::Vector3d(0, 0, 0)), 10.0);
  }
  EXPECT_GE(accuracy.valid_share(), 0.6);
  EXPECT_GE(accuracy.within_share(), 0.9);
}

TEST(NormalAccuracy, OfANonRepetitiveSensorIsWithinFiveDegreesForNineInTen) {
  std::mt19937_64 rng = test::rng();
  NormalEstimator estimator;
  Accuracy accuracy;
  for (const double size : kRoomSizes) {
    const test::FurnishedRoom room(size, rng);
    const test::TrueScan scan = room.scan(test::non_repetitive_directions(20'000, size), 0.01, rng);
    accuracy.add(scan, estimator.estimate(scan.points, Eigen::Vector3d(0, 0, 0)), 5.0);
  }
  EXPECT_GE(accuracy.valid_share(), 0.6);
  EXPECT_GE(accuracy.within_share(), 0.9);
}

}  // namespace
}  // namespace nvm
