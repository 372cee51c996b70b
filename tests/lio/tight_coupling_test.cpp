// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/tight_coupling.hpp"

#include <gtest/gtest.h>

namespace nvm::lio {
namespace {

constexpr double kDeviation = 0.05;  // of a residual [m]

/// A turned body with a LiDAR far off its centre.
NavState turned_state() {
  NavState state;
  state.T_world_body.linear() = so3_exp({0.3, -0.5, 1.0});
  state.T_world_body.translation() << 1.0, 2.0, -3.0;
  state.T_body_lidar.linear() = so3_exp({-0.2, 0.8, 0.4});
  state.T_body_lidar.translation() << 0.5, -0.3, 0.7;
  return state;
}

/// How the LiDAR's pose, as a PoseStep, follows a change of part `i` of the state.
PoseStep lidar_step(const NavState& state, int i) {
  constexpr double kStep = 1e-6;
  const Pose before = boxplus(state, -kStep * NavVector::Unit(i)).T_world_lidar();
  const Pose after = boxplus(state, kStep * NavVector::Unit(i)).T_world_lidar();
  PoseStep step;
  step.head<3>() = so3_log(before.linear().transpose() * after.linear());
  step.tail<3>() = after.translation() - before.translation();
  return step / (2.0 * kStep);
}

TEST(TightCoupling, BringsThePoseOfTheLidarToTheStateOfTheBody) {
  AlignOptions align;
  align.min_observability = 0.0;
  const TightCoupling coupling(align, kDeviation);
  const NavState state = turned_state();
  NormalEquations equations;
  equations.information.diagonal() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  equations.information(0, 4) = equations.information(4, 0) = 0.7;
  equations.gradient << 0.1, -0.2, 0.3, 0.5, -0.7, 0.9;
  Information information;
  MatchResult result;
  coupling.inform(equations, state, information, result);

  // The extrinsic is left alone, and so is what no pose depends on.
  for (int i = 0; i < kMeasuredSize; ++i) {
    const bool is_pose = i < kVelocity;
    const PoseStep step = is_pose ? lidar_step(state, i) : PoseStep(PoseStep::Zero());
    EXPECT_NEAR(information.vector[i] * kDeviation * kDeviation, step.dot(equations.gradient), 1e-8)
        << "part " << i;
    for (int j = 0; j < kMeasuredSize; ++j) {
      const PoseStep other = j < kVelocity ? lidar_step(state, j) : PoseStep(PoseStep::Zero());
      EXPECT_NEAR(
          information.matrix(i, j) * kDeviation * kDeviation,
          step.dot(equations.information * other),
          1e-7)
          << "parts " << i << " and " << j;
    }
  }
}

}  // namespace
}  // namespace nvm::lio
