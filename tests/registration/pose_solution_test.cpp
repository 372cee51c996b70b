// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/registration/pose_solution.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/random_vector.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using test::random_vector;

Pose random_pose(std::mt19937_64& rng) {
  Pose pose = Pose::Identity();
  pose.linear() = so3_exp(3.0 * random_vector(rng));
  pose.translation() = 10.0 * random_vector(rng);
  return pose;
}

TEST(PointToPlane, JacobianMatchesNumericDifferentiation) {
  auto rng = test::rng();
  for (int seed = 0; seed < 100; ++seed) {
    const Pose T_map_scan = random_pose(rng);
    const Eigen::Vector3d p_scan = 5.0 * random_vector(rng);
    const Eigen::Vector3d n_map = random_vector(rng).normalized();
    const PoseStep jacobian =
        point_to_plane_jacobian(p_scan, T_map_scan.linear().transpose() * n_map, n_map);
    for (int i = 0; i < 6; ++i) {
      constexpr double kStep = 1e-6;
      const auto residual = [&](double h) {
        return n_map.dot(retract(T_map_scan, PoseStep(h * PoseStep::Unit(i))) * p_scan);
      };
      EXPECT_NEAR(jacobian[i], (residual(kStep) - residual(-kStep)) / (2.0 * kStep), 1e-7);
    }
  }
}

TEST(RobustKernel, WeightIsTheDerivativeOfTheLossOverTheResidual) {
  using Type = RobustKernel::Type;
  const double c = 0.1;
  const auto loss = [c](Type type, double e) {
    if (type == Type::kHuber) {
      return std::abs(e) <= c ? 0.5 * e * e : c * (std::abs(e) - 0.5 * c);
    }
    return type == Type::kCauchy ? 0.5 * c * c * std::log1p(e * e / (c * c)) : 0.5 * e * e;
  };
  for (const Type type : {Type::kNone, Type::kHuber, Type::kCauchy}) {
    for (const double e : {-1.0, -0.09, 0.01, 0.05, 0.2, 3.0}) {
      const double slope = (loss(type, e + 1e-6) - loss(type, e - 1e-6)) / 2e-6;
      EXPECT_NEAR((RobustKernel{type, c}.weight(e)), slope / e, 1e-6);
    }
    EXPECT_EQ((RobustKernel{type, c}.weight(0.0)), 1.0);
  }
  EXPECT_THROW((RobustKernel{Type::kHuber, 0.0}.validate()), std::invalid_argument);
}

Association on_plane(const Eigen::Vector3d& normal, double distance) {
  return {normal, distance, 1.0, AssociationStatus::kValid};
}

// Minimises rho(w e) over the weighted residuals: the kernel must see w e, not e.
TEST(NormalEquations, GradientIsThatOfTheLossOfTheWeightedResidual) {
  auto rng = test::rng();
  const RobustKernel kernel{RobustKernel::Type::kCauchy, 0.05};
  const auto loss = [&](double e) {
    return 0.5 * kernel.scale * kernel.scale * std::log1p(std::pow(e / kernel.scale, 2));
  };
  for (const double weight : {1.0, 0.5, 0.1}) {
    const Pose pose = random_pose(rng);
    const Eigen::Vector3d p_scan = random_vector(rng);
    const Eigen::Vector3d normal = random_vector(rng).normalized();
    const double distance = 0.2;
    NormalEquations equations;
    equations.add(
        p_scan, pose.linear(), {normal, distance, weight, AssociationStatus::kValid}, kernel);
    for (int i = 0; i < 6; ++i) {
      constexpr double kStep = 1e-6;
      const auto loss_at = [&](double h) {
        const Pose moved = retract(pose, PoseStep(h * PoseStep::Unit(i)));
        return loss(weight * (distance + normal.dot(moved * p_scan - pose * p_scan)));
      };
      EXPECT_NEAR(equations.gradient[i], (loss_at(kStep) - loss_at(-kStep)) / (2.0 * kStep), 1e-7);
    }
  }
}

TEST(NormalEquations, SolutionZeroesTheResidualsOfASmallDisplacement) {
  auto rng = test::rng();
  for (int seed = 0; seed < 50; ++seed) {
    const Pose truth = random_pose(rng);
    const Pose guess = retract(truth, PoseStep::Constant(1e-5));
    NormalEquations equations;
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector3d p_scan = 5.0 * random_vector(rng);
      const Eigen::Vector3d normal = random_vector(rng).normalized();
      const double distance = normal.dot(guess * p_scan - truth * p_scan);
      equations.add(p_scan, guess.linear(), on_plane(normal, distance), RobustKernel{});
    }
    const PoseSolution solution = solve(equations, 1e-6);
    EXPECT_EQ(solution.degenerate_directions, 0);
    EXPECT_TRUE(retract(guess, solution.step).isApprox(truth, 1e-8));
  }
}

TEST(NormalEquations, ALonePlaneLeavesThreeDirectionsAlone) {
  auto rng = test::rng();
  NormalEquations equations;
  for (int i = 0; i < 40; ++i) {
    Eigen::Vector3d p_scan = 5.0 * random_vector(rng);
    p_scan.z() = -1.0;
    equations.add(
        p_scan, Eigen::Matrix3d::Identity(), on_plane({0.0, 0.0, 1.0}, 0.1), RobustKernel{});
  }
  const PoseSolution solution = solve(equations, 1e-3);
  EXPECT_EQ(solution.degenerate_directions, 3);
  EXPECT_NEAR(solution.step[5], -0.1, 1e-9);
  for (const int untouched : {2, 3, 4}) {
    EXPECT_NEAR(solution.step[untouched], 0.0, 1e-9);
  }
  EXPECT_TRUE(std::is_sorted(solution.observability.begin(), solution.observability.end()));
  EXPECT_NEAR(solution.observability[2], 0.0, 1e-12);
}

TEST(NormalEquations, NothingKnownMeansNoStep) {
  const PoseSolution solution = solve(NormalEquations{}, 1e-3);
  EXPECT_EQ(solution.degenerate_directions, 6);
  EXPECT_TRUE(solution.step.isZero());
}

}  // namespace
}  // namespace nvm
