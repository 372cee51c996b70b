// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/normal/normal_estimator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "normal/scans.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TEST(NormalsPerCell, AreSharedByThePointsOfACell) {
  std::mt19937_64 rng = test::rng();
  const test::TrueScan scan = room_scan(rng);
  NormalOptions options;
  options.method = NormalMethod::kPerCell;
  const NormalResult result = estimate_normals(scan.points, Vector3d(0, 0, 0), options);
  std::set<std::array<float, 3>> distinct;
  for (const Vector3f& normal : result.normals) {
    const Vector3f axis = normal.x() < 0.0F ? Vector3f(-normal) : normal;
    distinct.insert({axis.x(), axis.y(), axis.z()});
  }
  EXPECT_LT(distinct.size(), result.stats.valid / 2);
}

TEST(NormalsPerCell, AreGivenAtQueriesToo) {
  NormalOptions options;
  options.method = NormalMethod::kPerCell;
  NormalEstimator estimator(options);
  const std::vector<Vector3d> queries{{2.01, 0.0, 0.0}, {2.0, 0.3, 0.1}, {9.0, 0.0, 0.0}};
  const NormalResult& result = estimator.estimate_at(queries, wall(2.0), Vector3d(0, 0, 0));
  EXPECT_NEAR(result.normals[0].x(), -1.0F, 1e-5F);
  EXPECT_NEAR(result.normals[1].x(), -1.0F, 1e-5F);
  EXPECT_EQ(result.status[2], NormalStatus::kFewNeighbors);
}

TEST(NormalsOfDenseClouds, AreBoundedInWork) {
  std::mt19937_64 rng = test::rng();
  std::normal_distribution<double> spot(0.0, 0.01);
  std::vector<Vector3d> points(100'000, Vector3d(2, 0, 0));
  for (int i = 0; i < 100'000; ++i) {
    points.emplace_back(2.0 + spot(rng), 3.0 + spot(rng), spot(rng));
  }
  const NormalResult result = estimate_normals(points, Vector3d(0, 0, 0), fixed_radius(0.3));
  EXPECT_EQ(result.stats.line_like, 100'000U);
  EXPECT_EQ(result.stats.not_planar, 100'000U);
}

struct EastNorthUp {
  float x, y, z;
  int intensity;
};

TEST(NormalEstimator, ReadsAnyPointRecord) {
  const std::vector<Vector3d> points = wall(2.0);
  std::vector<EastNorthUp> records;
  for (const Vector3d& p : points) {
    records.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 7});
  }
  const NormalResult result = estimate_normals(records, EastNorthUp{0, 0, 0, 0});
  EXPECT_EQ(result.stats.valid, records.size());
}

TEST(NormalEstimator, RefusesBadOptions) {
  NormalOptions options;
  options.min_neighbors = 0;
  EXPECT_THROW(NormalEstimator{options}, std::invalid_argument);
}

}  // namespace
}  // namespace nvm
