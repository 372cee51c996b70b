// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/continuous_matcher.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

#include "lio/map/lio_map.hpp"
#include "lio/match/coupled_matcher.hpp"
#include "nvm/registration/association.hpp"
#include "nvm/registration/normal_equations.hpp"
#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::lio {
namespace {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kResidualDeviation = 0.05;  // [m]
constexpr double kPositionDoubt = 0.02;      // of the prediction [m]
constexpr double kRotationDoubt = 0.01;      // [rad]

/// A scan in a mapped room, with the prediction a little off.
class ContinuousMatcherTest : public ::testing::Test {
 protected:
  ContinuousMatcherTest() : map_(make_map(MapType::kNvm, {})) {
    truth_.linear() = so3_exp({0.2, -0.3, 1.0});
    truth_.translation() << 0.3, -0.4, 0.2;
    const test::RoomScan mapped = room_.scan(truth_, 40'000, 0.0, rng_);
    map_->insert(
        mapped.points, mapped.normals, std::vector<PointValues>(mapped.points.size()), truth_);
    const test::RoomScan seen = room_.scan(truth_, 1500, 0.0, rng_);
    scan_.scan.points = seen.points;
    scan_.scan.viewpoints.assign(seen.points.size(), Eigen::Vector3f::Zero());
    scan_.normals = seen.normals;
    scan_.keypoints.resize(seen.points.size());
    std::iota(scan_.keypoints.begin(), scan_.keypoints.end(), 0U);
    predicted_.T_world_body = truth_;
    predicted_.T_world_body.translation() += Eigen::Vector3d(0.006, -0.004, 0.003);
    align_.max_iterations = 1;  // one step of Gauss-Newton is what the oracle takes
    align_.kernel.type = RobustKernel::Type::kNone;
  }

  /// Sure of everything but the pose, of which it doubts each part on its own.
  ErrorStateFilter predicted_filter() const {
    NavCovariance covariance = 1e-8 * NavCovariance::Identity();
    covariance.block<3, 3>(kPosition, kPosition)
        .diagonal()
        .setConstant(kPositionDoubt * kPositionDoubt);
    covariance.block<3, 3>(kRotation, kRotation)
        .diagonal()
        .setConstant(kRotationDoubt * kRotationDoubt);
    return {predicted_, covariance, {}};
  }

  ErrorStateFilter matched(ScanMatcher& matcher) {
    ErrorStateFilter filter = predicted_filter();
    PreparedScan scan = scan_;
    EXPECT_TRUE(matcher.match(*map_, scan, filter).accepted);
    return filter;
  }

  void set_ages(double longest) {
    std::uniform_real_distribution<float> age(0.0F, static_cast<float>(longest));
    scan_.scan.ages.clear();
    for (std::size_t i = 0; i < scan_.scan.points.size(); ++i) {
      scan_.scan.ages.push_back(longest > 0.0 ? age(rng_) : 0.0F);
    }
  }

  /// What a motion that was wrong by up to `turn` and `shift` at the scan's begin makes of it.
  void smear(const Eigen::Vector3f& turn, const Eigen::Vector3f& shift) {
    for (std::size_t i = 0; i < scan_.scan.size(); ++i) {
      const float share = 10.0F * scan_.scan.ages[i];  // of 0.1 s
      for (Eigen::Vector3f* p : {&scan_.scan.points[i], &scan_.scan.viewpoints[i]}) {
        *p += share * (turn.cross(*p) + shift);
      }
    }
  }

  std::mt19937_64 rng_ = test::rng();
  test::Room room_;
  Pose truth_ = Pose::Identity();
  NavState predicted_;
  std::unique_ptr<LioMap> map_;
  PreparedScan scan_;
  AlignOptions align_;
};

Matrix6 pose_covariance(const ErrorStateFilter& filter) {
  return filter.covariance().topLeftCorner<6, 6>();  // position, rotation
}

TEST_F(ContinuousMatcherTest, IsTheDiscreteOneForAnInstantScan) {
  set_ages(0.0);
  ContinuousMatcher continuous(align_, kResidualDeviation, Executor());
  CoupledMatcher discrete(align_, kResidualDeviation, Executor());
  const ErrorStateFilter a = matched(continuous);
  const ErrorStateFilter b = matched(discrete);
  EXPECT_LT((a.state().T_world_body.matrix() - b.state().T_world_body.matrix()).norm(), 1e-9);
  EXPECT_LT((a.covariance() - b.covariance()).norm(), 1e-9 * b.covariance().norm());
}

// The begin is eliminated: step and covariance of the end are those of the problem of both poses.
TEST_F(ContinuousMatcherTest, SolvesTheProblemOfBothPoses) {
  set_ages(0.1);
  const auto& ages = scan_.scan.ages;
  const double duration = *std::max_element(ages.begin(), ages.end());
  Matrix12 information = Matrix12::Zero();  // begin, end; each rotation, position
  Vector12 gradient = Vector12::Zero();
  LioMap::QueryContext context;
  const Pose& pose = predicted_.T_world_body;
  for (std::size_t i = 0; i < ages.size(); ++i) {
    const Eigen::Vector3d p_scan = scan_.scan.points[i].cast<double>();
    const Eigen::Vector3f n_map = pose.linear().cast<float>() * scan_.normals[i];
    NormalEquations at_point;
    at_point.add(
        p_scan,
        pose.linear(),
        associate(*map_, pose * p_scan, n_map, align_.association, context),
        align_.kernel);
    Eigen::Matrix<double, 6, 12> to_point;  // from both poses to the one at the point's time
    const double share = ages[i] / duration;
    to_point << share * Matrix6::Identity(), (1.0 - share) * Matrix6::Identity();
    information += to_point.transpose() * at_point.information * to_point;
    gradient += to_point.transpose() * at_point.gradient;
  }
  information /= kResidualDeviation * kResidualDeviation;
  gradient /= kResidualDeviation * kResidualDeviation;
  Vector12 tie;  // of the begin to the last scan's end, of the end to the prediction
  tie << Eigen::Vector3d::Constant(1.0 / (kRotationDoubt * kRotationDoubt + 9e-8)),
      Eigen::Vector3d::Constant(1.0 / (kPositionDoubt * kPositionDoubt + 1e-6)),
      Eigen::Vector3d::Constant(1.0 / (kRotationDoubt * kRotationDoubt)),
      Eigen::Vector3d::Constant(1.0 / (kPositionDoubt * kPositionDoubt));
  information.diagonal() += tie;
  const Matrix12 covariance = information.inverse();
  const Vector12 step = -covariance * gradient;

  ContinuousMatcher matcher(align_, kResidualDeviation, Executor());
  const ErrorStateFilter filter = matched(matcher);
  const NavVector moved = boxminus(filter.state(), predicted_);
  EXPECT_LT(
      (moved.segment<3>(kRotation) - step.segment<3>(6)).norm(), 0.01 * step.tail<6>().norm());
  EXPECT_LT(
      (moved.segment<3>(kPosition) - step.segment<3>(9)).norm(), 0.01 * step.tail<6>().norm());
  EXPECT_GT(step.tail<3>().norm(), 0.002);
  Matrix6 expected;  // position, rotation
  expected << covariance.block<3, 3>(9, 9), covariance.block<3, 3>(9, 6),
      covariance.block<3, 3>(6, 9), covariance.block<3, 3>(6, 6);
  EXPECT_LT((pose_covariance(filter) - expected).norm(), 0.01 * expected.norm());
}

// A motion that was wrong at the scan's begin has smeared the points; afterwards they lie where
// they were measured.
TEST_F(ContinuousMatcherTest, PutsThePointsWhereTheMotionOfBothPosesHasThem) {
  set_ages(0.1);
  align_.max_iterations = 10;
  const std::vector<Eigen::Vector3f> true_points = scan_.scan.points;
  smear({0.004F, -0.003F, 0.005F}, {0.01F, 0.02F, -0.015F});
  predicted_.T_world_body = truth_;
  ContinuousMatcher matcher(align_, 0.1 * kResidualDeviation, Executor());  // surer than the ties
  ErrorStateFilter filter = predicted_filter();
  PreparedScan scan = scan_;
  ASSERT_TRUE(matcher.match(*map_, scan, filter).accepted);
  float left = 0.0F;
  float left_of_viewpoints = 0.0F;
  for (std::size_t i = 0; i < true_points.size(); ++i) {
    left = std::max(left, (scan.scan.points[i] - true_points[i]).norm());
    left_of_viewpoints = std::max(left_of_viewpoints, scan.scan.viewpoints[i].norm());
  }
  EXPECT_LT(left, 0.006F);                // of 0.05
  EXPECT_LT(left_of_viewpoints, 0.001F);  // of 0.027
}

// The problem is all but linear: what the first step leaves to the tie, later ones leave too.
TEST_F(ContinuousMatcherTest, MoreStepsDoNotLoosenTheTieOfTheBegin) {
  set_ages(0.1);
  smear(Eigen::Vector3f::Zero(), {0.01F, 0.02F, -0.015F});
  predicted_.T_world_body = truth_;
  align_.converged_rotation = align_.converged_translation = 0.0;
  const auto oldest = static_cast<std::size_t>(
      std::max_element(scan_.scan.ages.begin(), scan_.scan.ages.end()) - scan_.scan.ages.begin());
  const auto begin_after = [&](int steps) {
    align_.max_iterations = steps;
    ContinuousMatcher matcher(align_, 10.0 * kResidualDeviation, Executor());  // the tie holds
    ErrorStateFilter filter = predicted_filter();
    PreparedScan scan = scan_;
    EXPECT_TRUE(matcher.match(*map_, scan, filter).accepted);
    return Eigen::Vector3f(scan.scan.viewpoints[oldest] - scan_.scan.viewpoints[oldest]);
  };
  const Eigen::Vector3f once = begin_after(1);
  EXPECT_GT(once.norm(), 0.001F);
  EXPECT_LT((begin_after(10) - once).norm(), 0.1F * once.norm());
}

}  // namespace
}  // namespace nvm::lio
