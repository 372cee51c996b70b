// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/faint_direction.hpp"

#include <gmock/gmock.h>

#include <random>
#include <string>

#include "nvm/registration/pose_solution.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

using ::testing::HasSubstr;

constexpr double kRange = 3.0;  // [m]

// Of points on four walls, of which `share` lie on the floor instead.
AlignResult alignment(double share, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::bernoulli_distribution on_floor(share);
  NormalEquations equations;
  for (int i = 0; i < 4000; ++i) {
    const double side = i % 4 < 2 ? 1.0 : -1.0;
    Eigen::Vector3d normal =
        i % 2 == 0 ? Eigen::Vector3d(side, 0.0, 0.0) : Eigen::Vector3d(0.0, side, 0.0);
    Eigen::Vector3d point = kRange * Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng));
    if (on_floor(rng)) {
      normal = Eigen::Vector3d::UnitZ();
      point.z() = -1.0;
    }
    equations.add(
        point,
        Eigen::Matrix3d::Identity(),
        {normal, 0.0, 1.0, AssociationStatus::kValid},
        RobustKernel{});
  }
  AlignResult result;
  result.information = equations.information;
  result.observability = solve(equations, 1e-3).observability;
  return result;
}

std::string finding_after(int faint, int clear, const Eigen::Matrix3d& R_body_scan) {
  auto rng = test::rng();
  FaintDirection direction;
  for (int i = 0; i < faint + clear; ++i) {
    direction.add(alignment(i < faint ? 0.004 : 0.05, rng), kRange, R_body_scan);
  }
  return direction.finding();
}

TEST(FaintDirection, NamesTheHeightThatFewPointsTell) {
  const std::string finding = finding_after(60, 0, Eigen::Matrix3d::Identity());
  EXPECT_THAT(finding, HasSubstr("in 60 of 60 scans"));
  EXPECT_THAT(finding, HasSubstr("the pose along ("));
  EXPECT_THAT(finding, HasSubstr("1.00) ("));
  EXPECT_THAT(finding, HasSubstr("(0.4 %"));
}

TEST(FaintDirection, IsSilentWhereMostScansTellEnough) {
  EXPECT_EQ(finding_after(0, 60, Eigen::Matrix3d::Identity()), "");
  EXPECT_EQ(finding_after(30, 30, Eigen::Matrix3d::Identity()), "");
  EXPECT_NE(finding_after(31, 29, Eigen::Matrix3d::Identity()), "");
}

TEST(FaintDirection, WaitsForTenScans) {
  EXPECT_EQ(finding_after(9, 0, Eigen::Matrix3d::Identity()), "");
  EXPECT_NE(finding_after(10, 0, Eigen::Matrix3d::Identity()), "");
}

}  // namespace
}  // namespace nvm::lio
