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

// The directions of the n-th frame of a sensor.
using Sensor = test::Directions (*)(double frame);

test::Directions vlp16(double) { return test::spinning_directions(16, 1500); }
test::Directions mid360(double frame) { return test::non_repetitive_directions(20'000, frame); }

Accuracy measure(Sensor sensor, NormalMethod method, double limit_deg) {
  std::mt19937_64 rng = test::rng();
  NormalOptions options;
  options.method = method;
  NormalEstimator estimator(options);
  Accuracy accuracy;
  for (const double size : kRoomSizes) {
    const test::FurnishedRoom room(size, rng);
    const test::TrueScan scan = room.scan(sensor(size), 0.01, rng);
    accuracy.add(scan, estimator.estimate(scan.points, Eigen::Vector3d(0, 0, 0)), limit_deg);
  }
  return accuracy;
}

TEST(NormalAccuracy, OfASpinningSensorIsWithinTenDegreesForNineInTen) {
  const Accuracy accuracy = measure(vlp16, NormalMethod::kBlockTree, 10.0);
  EXPECT_GE(accuracy.valid_share(), 0.6);
  EXPECT_GE(accuracy.within_share(), 0.9);
}

TEST(NormalAccuracy, OfANonRepetitiveSensorIsWithinFiveDegreesForNineInTen) {
  const Accuracy accuracy = measure(mid360, NormalMethod::kBlockTree, 5.0);
  EXPECT_GE(accuracy.valid_share(), 0.6);
  EXPECT_GE(accuracy.within_share(), 0.9);
}

TEST(NormalAccuracy, PerCellIsWithinTenDegreesForNineInTen) {
  for (const Sensor sensor : {vlp16, mid360}) {
    const Accuracy accuracy = measure(sensor, NormalMethod::kPerCell, 10.0);
    EXPECT_GE(accuracy.valid_share(), 0.6);
    EXPECT_GE(accuracy.within_share(), 0.9);
  }
}

}  // namespace
}  // namespace nvm
