// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "lio/analytic_motion.hpp"
#include "lio/match/degeneracy.hpp"
#include "lio/state/error_state_filter.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

NavVector random_error(std::mt19937_64& generator, double scale) {
  std::normal_distribution<double> normal(0.0, scale);
  return NavVector::NullaryExpr([&] { return normal(generator); });
}

NavState tilted_state() {
  NavState state;
  state.T_world_body.linear() = so3_exp({0.3, -0.5, 1.0});
  state.gravity = so3_exp({0.05, -0.03, 0.0}) * state.gravity;
  return state;
}

TEST(NavState, BoxminusUndoesBoxplus) {
  auto generator = test::rng();
  for (int i = 0; i < 100; ++i) {
    const NavState state = boxplus(tilted_state(), random_error(generator, 0.3));
    const NavVector error = random_error(generator, 0.3);
    EXPECT_LT((boxminus(boxplus(state, error), state) - error).norm(), 1e-9);
  }
}

TEST(NavState, BoxminusJacobianMatchesDifferences) {
  auto generator = test::rng();
  const NavState reference = tilted_state();
  const NavState state = boxplus(reference, random_error(generator, 0.002));
  const auto J = boxminus_jacobian(state, reference);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < kNavSize; ++i) {
    const NavVector e = kStep * NavVector::Unit(i);
    const NavVector difference =
        (boxminus(boxplus(state, e), reference) - boxminus(boxplus(state, -e), reference)) /
        (2.0 * kStep);
    EXPECT_LT((J.col(i) - difference).norm(), 1e-3) << "column " << i;
  }
}

TEST(ErrorStateFilter, PredictionFollowsAnExactImu) {
  const test::AnalyticMotion motion;
  ErrorStateFilter filter(motion.state(0.0), NavCovariance::Identity(), {});
  for (int i = 0; i < 2000; ++i) {
    filter.predict(motion.imu(0.005 * i), motion.imu(0.005 * (i + 1)));
  }
  const Pose truth = motion.pose(10.0);
  EXPECT_LT((filter.state().T_world_body.translation() - truth.translation()).norm(), 0.01);
  EXPECT_LT(
      so3_log(filter.state().T_world_body.linear().transpose() * truth.linear()).norm(), 1e-4);
}

TEST(ErrorStateFilter, PredictedCovarianceMatchesThePropagatedErrors) {
  auto generator = test::rng();
  const test::AnalyticMotion motion;
  const NavState start = boxplus(motion.state(3.0), NavVector::Zero());
  const NavVector error = random_error(generator, 1e-4);
  NavCovariance P = error * error.transpose();
  ErrorStateFilter reference(start, P, {1e-12, 1e-12, 1e-12, 1e-12, 0.0});
  ErrorStateFilter disturbed(boxplus(start, error), P, {});
  for (int i = 600; i < 800; ++i) {
    const ImuSample a = motion.imu(0.005 * i);
    const ImuSample b = motion.imu(0.005 * (i + 1));
    reference.predict(a, b);
    disturbed.predict(a, b);
  }
  const NavVector propagated = boxminus(disturbed.state(), reference.state());
  const NavCovariance expected = propagated * propagated.transpose();
  EXPECT_LT((reference.covariance() - expected).norm(), 0.02 * expected.norm());
}

TEST(ErrorStateFilter, DoubtsATurnByAPercentOfIt) {
  constexpr double kTurn = 0.2;  // over 0.1 s [rad]
  const Eigen::Vector3d no_force = Eigen::Vector3d::Zero();
  ErrorStateFilter filter(tilted_state(), NavCovariance::Zero(), {1e-9, 1e-9, 1e-9, 1e-9});
  const Eigen::Vector3d rate = 10.0 * kTurn * Eigen::Vector3d(0.6, 0.0, 0.8);
  for (int i = 0; i < 20; ++i) {
    filter.predict({0.005 * i, rate, no_force}, {0.005 * (i + 1), rate, no_force});
  }
  const double variance = filter.covariance().block<3, 3>(kRotation, kRotation).trace() / 3.0;
  EXPECT_NEAR(std::sqrt(variance), 0.01 * kTurn, 0.001 * kTurn);
}

/// Planes around the origin, measured at known places of the body with independent noise.
struct PlaneWorld {
  double sigma = 0.01;
  std::vector<Eigen::Vector3d> body_points;
  std::vector<Eigen::Vector3d> normals;

  explicit PlaneWorld(std::mt19937_64& generator, int count = 30) {
    std::normal_distribution<double> normal(0.0, 1.0);
    for (int i = 0; i < count; ++i) {
      body_points.emplace_back(3.0 * normal(generator), 3.0 * normal(generator), normal(generator));
      normals.push_back(Eigen::Vector3d::Unit(i % 3));
    }
  }

  std::vector<double> measure(const Pose& truth, std::mt19937_64& generator) const {
    std::normal_distribution<double> noise(0.0, sigma);
    std::vector<double> distances;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      distances.push_back(normals[i].dot(truth * body_points[i]) + noise(generator));
    }
    return distances;
  }

  bool linearize(
      const NavState& state, const std::vector<double>& measured, Information& out) const {
    for (std::size_t i = 0; i < normals.size(); ++i) {
      MeasuredVector h = MeasuredVector::Zero();
      h.segment<3>(kPosition) = normals[i];
      h.segment<3>(kRotation) =
          body_points[i].cross(state.T_world_body.linear().transpose() * normals[i]);
      const double z = normals[i].dot(state.T_world_body * body_points[i]) - measured[i];
      out.matrix += h * h.transpose() / (sigma * sigma);
      out.vector += h * (z / (sigma * sigma));
    }
    return true;
  }
};

/// Normalised estimation error squared over the parts of the state that have a variance.
double nees(const ErrorStateFilter& filter, const NavState& truth) {
  const NavVector error = boxminus(filter.state(), truth);
  constexpr int kEstimated = kNavSize - 6;
  Eigen::Matrix<double, kEstimated, 1> e;
  Eigen::Matrix<double, kEstimated, kEstimated> P;
  const auto place = [](int i) { return i < kLidarPosition ? i : i + 6; };
  for (int i = 0; i < kEstimated; ++i) {
    e[i] = error[place(i)];
    for (int j = 0; j < kEstimated; ++j) {
      P(i, j) = filter.covariance()(place(i), place(j));
    }
  }
  return e.dot(P.ldlt().solve(e));
}

TEST(ErrorStateFilter, IsConsistentOverMonteCarloRuns) {
  auto generator = test::rng();
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto vector = [&] {
    return Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
  };
  const test::AnalyticMotion motion;
  const ImuNoise noise{1e-3, 1e-2, 1e-4, 1e-3, 0.0};
  const double dt = 0.01;
  NavVector sigma = NavVector::Zero();
  sigma.segment<3>(kPosition).setConstant(0.05);
  sigma.segment<3>(kRotation).setConstant(0.02);
  sigma.segment<3>(kVelocity).setConstant(0.1);
  sigma.segment<3>(kGyroBias).setConstant(0.01);
  sigma.segment<3>(kAccelBias).setConstant(0.05);
  sigma.segment<2>(kGravity).setConstant(0.01);
  constexpr int kRuns = 60;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const PlaneWorld world(generator);
    NavVector error = NavVector::NullaryExpr([&] { return normal(generator); });
    NavState truth = motion.state(2.0);
    Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();
    Eigen::Vector3d accel_bias = Eigen::Vector3d::Zero();
    ErrorStateFilter filter(
        boxplus(truth, sigma.cwiseProduct(error)),
        sigma.cwiseAbs2().asDiagonal().toDenseMatrix(),
        noise);
    ImuSample previous = motion.imu(2.0);
    for (int i = 1; i <= 300; ++i) {
      ImuSample next = motion.imu(2.0 + dt * i);
      gyro_bias += noise.gyro_bias * std::sqrt(dt) * vector();
      accel_bias += noise.accel_bias * std::sqrt(dt) * vector();
      // The filter uses the mean of two readings: white noise per interval, not per reading.
      const Eigen::Vector3d gyro_error = gyro_bias + noise.gyro / std::sqrt(dt) * vector();
      const Eigen::Vector3d accel_error = accel_bias + noise.accel / std::sqrt(dt) * vector();
      ImuSample a = previous;
      ImuSample b = next;
      a.gyro += gyro_error;
      b.gyro += gyro_error;
      a.accel += accel_error;
      b.accel += accel_error;
      filter.predict(a, b);
      previous = next;
      if (i % 10 == 0) {
        const auto measured = world.measure(motion.pose(next.time), generator);
        filter.update(
            [&](const NavState& state, bool, Information& out) {
              return world.linearize(state, measured, out);
            },
            {});
      }
    }
    truth = motion.state(previous.time);
    truth.gyro_bias = gyro_bias;
    truth.accel_bias = accel_bias;
    sum += nees(filter, truth);
  }
  // The mean of 60 runs with 17 degrees of freedom: 17 +- 4 standard deviations of 0.75.
  EXPECT_NEAR(sum / kRuns, 17.0, 3.0);
}

TEST(ErrorStateFilter, AnUnmeasuredDirectionKeepsThePrediction) {
  ErrorStateFilter filter({}, 1e-2 * NavCovariance::Identity(), {});
  filter.update(
      [](const NavState& state, bool, Information& out) {
        out.matrix(kPosition, kPosition) = 1e6;
        out.vector[kPosition] = 1e6 * (state.T_world_body.translation().x() - 0.5);
        return true;
      },
      {});
  EXPECT_NEAR(filter.state().T_world_body.translation().x(), 0.5, 1e-3);
  EXPECT_EQ(filter.state().T_world_body.translation().y(), 0.0);
  EXPECT_NEAR(filter.covariance()(1, 1), 1e-2, 1e-12);
}

TEST(ErrorStateFilter, KeepsThePredictionWhenTheLinearizerRefuses) {
  ErrorStateFilter filter({}, NavCovariance::Identity(), {});
  const UpdateResult result =
      filter.update([](const NavState&, bool, Information&) { return false; }, {});
  EXPECT_FALSE(result.applied);
  EXPECT_TRUE(filter.covariance().isIdentity());
}

TEST(ErrorStateFilter, AsksForNewCorrespondencesOnceConverged) {
  ErrorStateFilter filter({}, NavCovariance::Identity(), {});
  std::vector<bool> asked;
  const UpdateResult result = filter.update(
      [&](const NavState& state, bool associate, Information& out) {
        asked.push_back(associate);
        out.matrix.diagonal().setConstant(1e6);
        out.vector.head<3>() = 1e6 * (state.T_world_body.translation() - Eigen::Vector3d(1, 2, 3));
        return true;
      },
      {});
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(asked, (std::vector<bool>{true, false, true}));
}

TEST(ErrorStateFilter, PoseObservationPullsTowardsThePose) {
  ErrorStateFilter filter({}, 1e-2 * NavCovariance::Identity(), {});
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(0.1, 0.0, 0.0);
  pose.linear() = so3_exp({0.0, 0.0, 0.1});
  filter.observe_pose(pose, 1e-2 * Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Identity());
  EXPECT_NEAR(filter.state().T_world_body.translation().x(), 0.05, 1e-9);
  EXPECT_NEAR(so3_log(filter.state().T_world_body.linear()).z(), 0.05, 1e-6);
}

TEST(Degeneracy, ACorridorHasOneUnobservedDirection) {
  Information information;
  const auto add = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    MeasuredVector h = MeasuredVector::Zero();
    h.segment<3>(kPosition) = n;
    h.segment<3>(kRotation) = p.cross(n);
    h.segment<3>(kVelocity) = -0.05 * n;
    information.matrix += h * h.transpose();
    information.vector += 0.01 * h;
  };
  for (double i = -10.0; i <= 10.0; i += 1.0) {
    add({i, 1.0, 0.3}, Eigen::Vector3d::UnitY());
    add({i, -1.0, -0.2}, Eigen::Vector3d::UnitY());
    add({i, 0.4, -1.0}, Eigen::Vector3d::UnitZ());
    add({i, -0.4, 1.0}, Eigen::Vector3d::UnitZ());
  }
  EXPECT_EQ(remove_unobserved(information, 5.0, 1e-3).count(), 1);
  EXPECT_NEAR(information.matrix(kPosition, kPosition), 0.0, 1e-9);
  EXPECT_NEAR(information.matrix(kVelocity, kVelocity), 0.0, 1e-9);
  EXPECT_GT(information.matrix(1, 1), 10.0);
}

TEST(Degeneracy, NothingAtAllIsSixDirections) {
  Information information;
  EXPECT_EQ(remove_unobserved(information, 5.0, 1e-3).count(), 6);
}

}  // namespace
}  // namespace nvm::lio
