// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>
#include <vector>

#include "normal/scans.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// The least-squares plane of the points within `radius` of `point`.
struct Fit {
  Fit(const std::vector<Vector3f>& points, const Vector3f& point, float radius) {
    std::vector<Vector3d> near;
    for (const Vector3f& other : points) {
      if ((other - point).norm() <= radius) {
        near.push_back(other.cast<double>());
        mean += near.back();
      }
    }
    mean /= static_cast<double>(near.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vector3d& p : near) {
      covariance += (p - mean) * (p - mean).transpose() / static_cast<double>(near.size());
    }
    variance = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0];
  }

  Vector3d mean = Vector3d::Zero();
  double variance = 0.0;  ///< of the points across the plane [m^2]
};

TEST(PlaneFit, OffsetAndVarianceAreThoseOfTheNeighboursOfEachPoint) {
  constexpr float kRadius = 0.4F;
  std::mt19937_64 rng = test::rng();
  const std::vector<Vector3f> points = room_scan(rng).points;
  const NormalResult result = estimate_normals(points, Vector3d(0, 0, 0), fixed_radius(kRadius));
  std::size_t checked = 0;
  for (std::size_t i = 0; i < points.size(); i += 5) {
    if (result.status[i] != NormalStatus::kValid) {
      EXPECT_EQ(result.plane_offsets[i], 0.0F);
      EXPECT_EQ(result.plane_variances[i], 0.0F);
      continue;
    }
    const Fit fit(points, points[i], kRadius);
    const Vector3d normal = result.normals[i].cast<double>();
    EXPECT_NEAR(
        static_cast<double>(result.plane_offsets[i]),
        normal.dot(fit.mean - points[i].cast<double>()),
        1e-4);
    EXPECT_NEAR(
        static_cast<double>(result.plane_variances[i]), fit.variance, 0.01 * fit.variance + 1e-7);
    ++checked;
  }
  EXPECT_GT(checked, 300U);
}

// Where the radius covers all cells, the plane of each cell is that of all points.
TEST(PlaneFit, OfACellIsThatOfItsNeighboursAsSeenFromEachPoint) {
  std::mt19937_64 rng = test::rng();
  std::normal_distribution<float> noise(0.0F, 0.02F);
  std::vector<Vector3f> points;
  for (const Vector3d& point : wall(2.0)) {
    points.emplace_back(point.cast<float>() + Vector3f(noise(rng), noise(rng), noise(rng)));
  }
  constexpr float kRadius = 3.0F;
  NormalOptions options = fixed_radius(kRadius);
  options.method = NormalMethod::kPerCell;
  const NormalResult result = estimate_normals(points, Vector3d(0, 0, 0), options);
  ASSERT_EQ(result.stats.valid, points.size());
  const Fit fit(points, points[0], kRadius);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(
        static_cast<double>(result.plane_offsets[i]),
        result.normals[i].cast<double>().dot(fit.mean - points[i].cast<double>()),
        1e-4);
    EXPECT_NEAR(static_cast<double>(result.plane_variances[i]), fit.variance, 0.01 * fit.variance);
  }
}

TEST(PlaneFit, OffsetsLieAlongTheNormalThatLooksBack) {
  std::vector<Vector3d> points = wall(2.0);
  points[220].x() += 0.05;  // behind its wall: the plane lies before it
  const NormalResult result = estimate_normals(points, Vector3d(0, 0, 0), fixed_radius(0.3));
  ASSERT_EQ(result.status[220], NormalStatus::kValid);
  EXPECT_LT(result.normals[220].x(), -0.9F);
  EXPECT_NEAR(result.plane_offsets[220], 0.05F, 0.005F);
}

}  // namespace
}  // namespace nvm
