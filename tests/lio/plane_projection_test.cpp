// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/plane_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "nvm/map/sighting.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

constexpr double kNoise = 0.01;

// A wall of 2 x 2 m across the x axis, 2 m away.
DeskewedScan wall(std::mt19937_64& rng) {
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  std::normal_distribution<float> noise(0.0F, static_cast<float>(kNoise));
  DeskewedScan scan;
  for (int i = 0; i < 4000; ++i) {
    scan.points.emplace_back(2.0F + noise(rng), place(rng), place(rng));
    scan.viewpoints.emplace_back(Eigen::Vector3f::Zero());
    scan.ages.push_back(0.0F);
  }
  return scan;
}

double deviation(const DeskewedScan& scan) {
  double sum = 0.0;
  for (const Eigen::Vector3f& point : scan.points) {
    sum += std::pow(static_cast<double>(point.x()) - 2.0, 2);
  }
  return std::sqrt(sum / static_cast<double>(scan.size()));
}

class PlaneProjection : public ::testing::TestWithParam<NormalMethod> {
 protected:
  NormalEstimator estimator() const {
    NormalOptions options;
    options.min_radius = options.max_radius = 0.3;
    options.method = GetParam();
    return NormalEstimator(options);
  }
};

TEST_P(PlaneProjection, TakesMostOfTheNoiseOffAWall) {
  auto rng = test::rng();
  DeskewedScan scan = wall(rng);
  NormalEstimator normals = estimator();
  project_to_planes(normals.estimate(scan.points, scan.viewpoints), 0.05, scan);
  EXPECT_LT(deviation(scan), 0.25 * kNoise);
}

TEST_P(PlaneProjection, LeavesPointsFarFromTheirPlaneAndTakesTheirNormal) {
  auto rng = test::rng();
  DeskewedScan scan = wall(rng);
  scan.points[0] = {1.9F, 0.0F, 0.0F};
  NormalEstimator normals = estimator();
  const auto kept = project_to_planes(normals.estimate(scan.points, scan.viewpoints), 0.05, scan);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(1.9F, 0.0F, 0.0F));
  EXPECT_TRUE(is_sighting(kept[0]));
  EXPECT_FALSE(is_sighting(kept[1]));
}

TEST_P(PlaneProjection, TrustsNoSideThatABeamGrazes) {
  auto rng = test::rng();
  DeskewedScan scan = wall(rng);
  for (Eigen::Vector3f& viewpoint : scan.viewpoints) {
    viewpoint = {1.9F, 30.0F, 0.0F};
  }
  NormalEstimator normals = estimator();
  for (const Eigen::Vector3f& normal :
       project_to_planes(normals.estimate(scan.points, scan.viewpoints), 0.05, scan)) {
    EXPECT_TRUE(is_sighting(normal));
  }
}

// A second wall across the end of the first.
TEST_P(PlaneProjection, LetsNoCornerPullAWall) {
  auto rng = test::rng();
  DeskewedScan scan = wall(rng);
  const std::size_t wall_points = scan.size();
  for (std::size_t i = 0; i < wall_points; ++i) {
    const Eigen::Vector3f p = scan.points[i];
    scan.points.emplace_back(2.0F + p.y() - 1.0F, 1.0F + (p.x() - 2.0F), p.z());
    scan.viewpoints.emplace_back(Eigen::Vector3f::Zero());
    scan.ages.push_back(0.0F);
  }
  NormalEstimator normals = estimator();
  const auto kept = project_to_planes(normals.estimate(scan.points, scan.viewpoints), 0.05, scan);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < wall_points; ++i) {
    if (!is_sighting(kept[i]) && scan.points[i].y() > 0.4F) {
      sum += static_cast<double>(scan.points[i].x()) - 2.0;
      ++count;
    }
  }
  EXPECT_GT(count, 50);
  EXPECT_LT(std::abs(sum / count), 0.2 * kNoise);
}

TEST_P(PlaneProjection, IsOffWithoutAnOffset) {
  auto rng = test::rng();
  DeskewedScan scan = wall(rng);
  const std::vector<Eigen::Vector3f> before = scan.points;
  NormalEstimator normals = estimator();
  const NormalResult& estimated = normals.estimate(scan.points, scan.viewpoints);
  EXPECT_EQ(project_to_planes(estimated, 0.0, scan), estimated.normals);
  EXPECT_EQ(scan.points, before);
}

// A ring on a floor is a line; a few returns from afar are too few.
TEST_P(PlaneProjection, SightsWhatIsThinlyCovered) {
  DeskewedScan scan;
  for (int i = 0; i < 40; ++i) {
    scan.points.emplace_back(3.0F, -1.0F + 0.05F * static_cast<float>(i), -1.2F);
  }
  scan.points.emplace_back(20.0F, 0.0F, 0.0F);
  scan.viewpoints.resize(scan.points.size(), Eigen::Vector3f::Zero());
  scan.ages.resize(scan.points.size(), 0.0F);
  const std::vector<Eigen::Vector3f> before = scan.points;
  NormalEstimator normals = estimator();
  const auto kept = project_to_planes(normals.estimate(scan.points, scan.viewpoints), 0.05, scan);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_TRUE(kept[i].isApprox(-0.5F * scan.points[i].normalized(), 1e-4F)) << i;
  }
  EXPECT_EQ(scan.points, before);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, PlaneProjection, ::testing::Values(NormalMethod::kBlockTree, NormalMethod::kPerCell));

}  // namespace
}  // namespace nvm::lio
