// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/normal/normal_estimator.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "normal/scans.hpp"
#include "nvm/core/executor_openmp.hpp"
#include "nvm/core/executor_tbb.hpp"
#include "nvm/core/thread_sanitizer.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

class NormalEstimation : public ::testing::TestWithParam<NormalMethod> {
 protected:
  static NormalOptions options(NormalOptions base = {}) {
    base.method = GetParam();
    return base;
  }
  static NormalStatus status_of_first(
      const std::vector<Vector3d>& points, const NormalOptions& base) {
    return estimate_normals(points, Vector3d(0, 0, 0), options(base)).status[0];
  }
};

const auto method_name = [](const auto& instance) -> std::string {
  switch (instance.param) {
    case NormalMethod::kBlockTree:
      return "BlockTree";
    case NormalMethod::kPerCell:
      return "PerCell";
  }
  return "";
};

INSTANTIATE_TEST_SUITE_P(
    Methods,
    NormalEstimation,
    ::testing::Values(NormalMethod::kBlockTree, NormalMethod::kPerCell),
    method_name);

// What only the exact method promises.
class ExactNormalEstimation : public NormalEstimation {};

INSTANTIATE_TEST_SUITE_P(
    Methods, ExactNormalEstimation, ::testing::Values(NormalMethod::kBlockTree), method_name);

TEST_P(NormalEstimation, OfAWallLooksBackAtTheViewpoint) {
  for (const double range : {2.0, -2.0}) {
    const NormalResult result = estimate_normals(wall(range), Vector3d(0, 0, 0), options());
    EXPECT_EQ(result.stats.valid, result.normals.size());
    for (const Vector3f& normal : result.normals) {
      EXPECT_NEAR(normal.x(), range > 0.0 ? -1.0F : 1.0F, 1e-5F);
    }
  }
}

TEST_P(NormalEstimation, TurnsEachNormalToItsOwnViewpoint) {
  const std::vector<Vector3d> points = wall(0.0);
  std::vector<Vector3f> viewpoints;
  for (std::size_t i = 0; i < points.size(); ++i) {
    viewpoints.emplace_back(i % 2 == 0 ? 3.0F : -3.0F, 0.0F, 0.0F);
  }
  const NormalResult result = estimate_normals(points, viewpoints, options());
  EXPECT_EQ(result.stats.valid, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(result.normals[i].x(), i % 2 == 0 ? 1.0F : -1.0F, 1e-5F);
  }
}

TEST_P(NormalEstimation, GivesUnitNormalsWhereValidAndZeroElsewhere) {
  std::mt19937_64 rng = test::rng();
  const test::TrueScan scan = room_scan(rng);
  const NormalResult result = estimate_normals(scan.points, Vector3f(0, 0, 0), options());
  EXPECT_GT(result.stats.valid, scan.points.size() / 3);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const bool is_valid = result.status[i] == NormalStatus::kValid;
    EXPECT_NEAR(result.normals[i].norm(), is_valid ? 1.0F : 0.0F, 1e-6F);
    EXPECT_LE(result.normals[i].dot(scan.points[i]), 0.0F);
  }
}

TEST_P(ExactNormalEstimation, RotatesWithThePoints) {
  std::mt19937_64 rng = test::rng();
  const test::TrueScan scan = room_scan(rng);
  const Eigen::Matrix3d R = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized().matrix();
  std::vector<Vector3d> rotated;
  for (const Vector3f& point : scan.points) {
    rotated.push_back(R * point.cast<double>());
  }
  const NormalResult before = estimate_normals(scan.points, Vector3d(0, 0, 0), options());
  const NormalResult after = estimate_normals(rotated, Vector3d(0, 0, 0), options());
  std::size_t differ = 0;  // a point at the rim of a neighbourhood may fall on the other side
  for (std::size_t i = 0; i < rotated.size(); ++i) {
    const Vector3d expected = R * before.normals[i].cast<double>();
    differ += (after.normals[i].cast<double>() - expected).norm() > 1e-3 ? 1U : 0U;
  }
  EXPECT_LT(differ, rotated.size() / 200);
}

TEST_P(ExactNormalEstimation, DoesNotDependOnWhereTheScanLies) {
  std::mt19937_64 rng = test::rng();
  const test::TrueScan scan = room_scan(rng);
  const NormalResult near = estimate_normals(scan.points, Vector3d(0, 0, 0), options());
  for (const Vector3d& offset : {Vector3d(1e6, -1e6, 1e6), Vector3d(-1e6, 1e6, -1e6)}) {
    std::vector<Vector3d> points;
    for (const Vector3f& point : scan.points) {
      points.push_back(point.cast<double>() + offset);
    }
    const NormalResult far = estimate_normals(points, offset, options());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      differ += (far.normals[i] - near.normals[i]).norm() > 1e-3F ? 1U : 0U;
    }
    EXPECT_LT(differ, points.size() / 200);
  }
}

TEST_P(NormalEstimation, IsTheSameForEveryExecutor) {
  std::mt19937_64 rng = test::rng();
  const test::TrueScan scan = room_scan(rng);
  const Vector3d viewpoint(0, 0, 0);
  const NormalResult serial = estimate_normals(scan.points, viewpoint, options());
  expect_same_bits(serial, estimate_normals(scan.points, viewpoint, options(), TbbExecutor()));
#ifndef NVM_THREAD_SANITIZER  // which does not see the synchronisation inside libgomp
  expect_same_bits(serial, estimate_normals(scan.points, viewpoint, options(), OpenMpExecutor()));
#endif
}

TEST_P(NormalEstimation, LeavesNoTraceOfEarlierScans) {
  std::mt19937_64 rng = test::rng();
  const test::TrueScan first = room_scan(rng), second = room_scan(rng);
  const std::vector<Vector3f> few(second.points.begin(), second.points.begin() + 1000);
  NormalEstimator estimator(options());
  for (const std::vector<Vector3f>& points : {first.points, few, second.points, {}, few}) {
    expect_same_bits(
        estimator.estimate(points, Vector3d(0, 0, 0)),
        estimate_normals(points, Vector3d(0, 0, 0), options()));
  }
}

TEST_P(NormalEstimation, GivesBadPointsAStatusAndLosesNothing) {
  std::vector<Vector3d> points = wall(2.0);
  const std::size_t good = points.size();
  points.insert(
      points.begin(),
      {{kNaN, 0, 0},
       {kInfinity, 0, 0},
       {0, -kInfinity, kNaN},
       {0, 0, 0},
       {0.1, 0, 0},
       {1e30, 0, 0},
       {-1e200, 1e200, 0},
       {5e3, 0, 0},
       {50, 0, 0}});
  const NormalResult result = estimate_normals(points, Vector3d(0, 0, 0), options());
  EXPECT_EQ(result.stats.valid, good);
  EXPECT_EQ(result.stats.non_finite, 3U);
  EXPECT_EQ(result.stats.too_near, 2U);
  EXPECT_EQ(result.stats.too_far, 3U);
  EXPECT_EQ(result.stats.few_neighbors, 1U);
  EXPECT_EQ(result.status[0], NormalStatus::kNonFinite);
  EXPECT_EQ(result.status[8], NormalStatus::kFewNeighbors);
}

TEST_P(ExactNormalEstimation, TellsLinesAndVolumesFromPlanes) {
  std::mt19937_64 rng = test::rng();
  std::uniform_real_distribution<double> unit(-0.2, 0.2);
  std::vector<Vector3d> line, ball, twins(30, Vector3d(2, 0, 0));
  for (int i = 0; i < 100; ++i) {
    line.emplace_back(2.0, 0.004 * (i - 50), 0.0);
    ball.emplace_back(2.0 + unit(rng), unit(rng), unit(rng));
  }
  EXPECT_EQ(status_of_first(line, fixed_radius(0.3)), NormalStatus::kLineLike);
  EXPECT_EQ(status_of_first(twins, fixed_radius(0.3)), NormalStatus::kLineLike);
  EXPECT_EQ(status_of_first(ball, fixed_radius(1.0)), NormalStatus::kNotPlanar);
  EXPECT_EQ(status_of_first({{2, 0, 0}}, fixed_radius(1.0)), NormalStatus::kFewNeighbors);
}

TEST_P(ExactNormalEstimation, CountsThePointItselfAndThoseAtExactlyTheRadius) {
  // Four neighbours at exactly 0.5 m, and the point: five.
  const std::vector<Vector3d> points{
      {2, 0, 0}, {2, 0.5, 0}, {2, -0.5, 0}, {2, 0, 0.5}, {2, 0, -0.5}};
  NormalOptions five = fixed_radius(0.5);
  five.min_neighbors = 5;
  EXPECT_EQ(status_of_first(points, five), NormalStatus::kValid);
  five.min_neighbors = 6;
  EXPECT_EQ(status_of_first(points, five), NormalStatus::kFewNeighbors);
}

TEST_P(NormalEstimation, RefusesAWrongNumberOfViewpoints) {
  const std::vector<Vector3d> points = wall(2.0), viewpoints(3, Vector3d(0, 0, 0));
  try {
    estimate_normals(points, viewpoints, options());
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("number of viewpoints = 3 must be"));
  }
}

TEST_P(NormalEstimation, MarksPointsWithABadViewpoint) {
  const std::vector<Vector3d> points = wall(2.0);
  std::vector<Vector3d> viewpoints(points.size(), Vector3d(0, 0, 0));
  viewpoints[0].x() = kNaN;  // also not usable as the local origin
  viewpoints[7].y() = kInfinity;
  viewpoints[9].x() = 1e9;
  const NormalResult result = estimate_normals(points, viewpoints, options());
  EXPECT_EQ(result.stats.non_finite, 2U);
  EXPECT_EQ(result.stats.too_far, 1U);
  EXPECT_EQ(result.stats.valid, points.size() - 3);
}

TEST_P(NormalEstimation, SurvivesViewpointsAGigametreApart) {
  std::vector<Vector3d> points = wall(2.0);
  std::vector<Vector3d> viewpoints(points.size(), Vector3d(0, 0, 0));
  points.emplace_back(1e9 + 2.0, 0, 0);
  viewpoints.emplace_back(1e9, 0, 0);
  points.emplace_back(9000.0, 9000.0, -9000.0);
  viewpoints.emplace_back(9001.0, 9000.0, -9000.0);
  const NormalResult result = estimate_normals(points, viewpoints, options());
  EXPECT_EQ(result.stats.far_origin, 1U);
  EXPECT_EQ(result.stats.few_neighbors, 1U);
  EXPECT_EQ(result.stats.valid, points.size() - 2);
}

TEST_P(ExactNormalEstimation, AtQueriesUsesTheNeighborsOfTheFullCloud) {
  std::mt19937_64 rng = test::rng();
  const test::TrueScan scan = room_scan(rng);
  std::vector<Vector3f> thinned;
  for (std::size_t i = 0; i < scan.points.size(); i += 7) {
    thinned.push_back(scan.points[i]);
  }
  thinned.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
  NormalEstimator estimator(options());
  const NormalResult all = estimator.estimate(scan.points, Vector3d(0, 0, 0));
  const NormalResult some = estimator.estimate_at(thinned, scan.points, Vector3d(0, 0, 0));
  ASSERT_EQ(some.normals.size(), thinned.size());
  EXPECT_EQ(some.status.back(), NormalStatus::kNonFinite);
  for (std::size_t i = 0; i + 1 < thinned.size(); ++i) {
    EXPECT_EQ(some.status[i], all.status[7 * i]);
    EXPECT_LT((some.normals[i] - all.normals[7 * i]).norm(), 1e-2F);
  }
}

}  // namespace
}  // namespace nvm
