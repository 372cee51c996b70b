// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/jet.hpp"
#include "support/rng.hpp"

namespace nvm::sim {
namespace {

Route square_route() {
  Route route;
  route.waypoints = {{0, 0, 0}, {6, 0, 0}, {6, 6, 0.5}, {0, 6, 0.5}, {0, 0, 0}};
  return route;
}

TEST(UniformSpline, GivesBackLinesAndKeepsWithinItsControlValues) {
  const UniformSpline<2> spline(10.0, 0.4, [](double t) {
    return std::array<double, 2>{3.0 + 0.5 * t, t < 5.0 ? 0.0 : 1.0};
  });
  for (double t = 0.0; t <= 10.0; t += 0.037) {
    const auto [line, step] = spline.at(t);
    EXPECT_NEAR(line, 3.0 + 0.5 * t, 1e-12);
    EXPECT_GE(step, -1e-15);
    EXPECT_LE(step, 1.0 + 1e-15);
  }
}

TEST(UniformSpline, IsSmoothAcrossKnots) {
  auto rng = test::rng();
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const UniformSpline<1> spline(
      10.0, 0.5, [&](double) { return std::array<double, 1>{uniform(rng)}; });
  constexpr double kStep = 1e-7;
  for (double knot = 0.5; knot < 9.9; knot += 0.5) {
    const Jet before = spline.at(time_jet(knot - kStep))[0];
    const Jet after = spline.at(time_jet(knot + kStep))[0];
    EXPECT_NEAR(before.value, after.value, 1e-5);
    EXPECT_NEAR(before.first, after.first, 1e-4);
    EXPECT_NEAR(before.second, after.second, 1e-3);
    // The slopes of the second derivative agree: the third derivative is continuous.
    const double slope_before =
        (before.second - spline.at(time_jet(knot - 1e-4))[0].second) / (1e-4 - kStep);
    const double slope_after =
        (spline.at(time_jet(knot + 1e-4))[0].second - after.second) / (1e-4 - kStep);
    EXPECT_NEAR(slope_before, slope_after, 0.2);
  }
}

TEST(Motion, DerivativesAreThoseOfThePose) {
  const Motion motion(square_route(), {}, 7, 0.0);
  constexpr double kStep = 1e-5;
  for (double t = 0.5; t < motion.duration() - 0.5; t += 0.173) {
    const Kinematics now = motion.kinematics(t);
    const Pose before = motion.pose(t - kStep);
    const Pose after = motion.pose(t + kStep);
    const Eigen::Vector3d velocity = (after.translation() - before.translation()) / (2.0 * kStep);
    const Eigen::Vector3d acceleration =
        (motion.kinematics(t + kStep).velocity - motion.kinematics(t - kStep).velocity) /
        (2.0 * kStep);
    const Eigen::Matrix3d turn = before.linear().transpose() * after.linear();
    EXPECT_TRUE(now.T_world_imu.isApprox(motion.pose(t), 1e-12));
    EXPECT_LT((now.velocity - velocity).norm(), 1e-8);
    EXPECT_LT((now.acceleration - acceleration).norm(), 1e-6);
    EXPECT_LT((now.angular_velocity - so3_log(turn) / (2.0 * kStep)).norm(), 1e-8);
  }
}

TEST(Motion, StandsStillAndTiltedAtTheStart) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    MotionOptions options;
    options.still_time = 2.5 + 0.1 * static_cast<double>(seed);
    const Motion motion(square_route(), options, seed, 0.0);
    const Pose start = motion.pose(0.0);
    for (double t = 0.0; t < options.still_time; t += 0.05) {
      const Kinematics now = motion.kinematics(t);
      EXPECT_LT((now.T_world_imu.translation() - start.translation()).norm(), 1e-9);
      EXPECT_LT(now.velocity.norm() + now.angular_velocity.norm(), 1e-9);
    }
    const double tilt = std::acos(start.linear()(2, 2)) * 180.0 / M_PI;
    EXPECT_NEAR(tilt, options.tilt_deg, 0.2);
  }
}

TEST(Motion, WalksAtAWalkingPace) {
  Route straight;
  straight.waypoints = {{0, 0, 0}, {40, 0, 0}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Motion motion(straight, {}, seed, 0.0);
    for (double t = 8.0; t < motion.duration() - 10.0; t += 0.5) {
      const double advance =
          motion.pose(t + 0.5).translation().x() - motion.pose(t - 0.5).translation().x();
      EXPECT_GT(advance, 0.5);
      EXPECT_LT(advance, 1.2);
    }
  }
}

TEST(Motion, StaysNearItsRoute) {
  const Route route = square_route();
  const Motion motion(route, {}, 3, 0.0);
  double farthest = 0.0;
  for (double t = 0.0; t < motion.duration(); t += 0.1) {
    const Eigen::Vector3d p = motion.pose(t).translation();
    const Eigen::Vector2d from_center = (p.head<2>() - Eigen::Vector2d(3.0, 3.0)).cwiseAbs();
    farthest = std::max(farthest, std::abs(from_center.maxCoeff() - 3.0));
    EXPECT_NEAR(p.z(), 1.55, 0.25 + 0.05);
  }
  EXPECT_LT(farthest, 0.2);
}

TEST(Motion, DiffersBySeedALittle) {
  const Route route = square_route();
  const Motion first(route, {}, 1, 20.0);
  const Motion second(route, {}, 2, 20.0);
  const double gap = (first.pose(12.0).translation() - second.pose(12.0).translation()).norm();
  EXPECT_GT(gap, 1e-3);
  EXPECT_LT(gap, 1.5);
  EXPECT_TRUE(first.pose(12.0).isApprox(Motion(route, {}, 1, 20.0).pose(12.0), 0.0));
}

TEST(Motion, RefusesRoutesThatCannotBeWalked) {
  Route route;
  EXPECT_THROW(Motion(route, {}, 1, 0.0), std::invalid_argument);
  route.waypoints = {{0, 0, 0}, {5, 0, 0}};
  route.laps = 2;
  EXPECT_THROW(Motion(route, {}, 1, 0.0), std::invalid_argument);
  route.laps = 1;
  route.waypoints.push_back({5, 0, 0});
  MotionOptions options;
  options.waypoint_jitter = 0.0;
  EXPECT_THROW(Motion(route, options, 1, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace nvm::sim
