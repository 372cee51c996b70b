// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/trajectory/trajectory_error.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>

#include "eval/synthetic_wall.hpp"
#include "support/rng.hpp"

namespace nvm::eval {
namespace {

using test::random_pose;
using test::rng;

/// A smooth loop at 1 m/s with turning body; `rate` poses per second from `begin` [s].
Trajectory loop(double begin, double end, double rate) {
  Trajectory trajectory;
  const int count = static_cast<int>(std::lround((end - begin) * rate));
  for (int i = 0; i <= count; ++i) {
    const double t = begin + i / rate;
    StampedPose stamped;
    stamped.time = t;
    stamped.pose.linear() = so3_exp({0.1 * std::sin(t), 0.1 * std::cos(t), 0.3 * t});
    stamped.pose.translation() =
        Eigen::Vector3d(3.0 * std::cos(t / 3.0), 3.0 * std::sin(t / 3.0), 0.1 * std::sin(2.0 * t));
    trajectory.push_back(stamped);
  }
  return trajectory;
}

Trajectory moved(Trajectory trajectory, const Pose& T) {
  for (StampedPose& stamped : trajectory) {
    stamped.pose = T * stamped.pose;
  }
  return trajectory;
}

TEST(Association, InterpolatesTheTruthAtTheEstimatesTimes) {
  const auto association = associate(loop(0.013, 9.9, 10.0), loop(0.0, 10.0, 100.0));
  EXPECT_EQ(association.pairs.size(), 100U);
  EXPECT_EQ(association.unmatched, 0U);
  for (const PosePair& pair : association.pairs) {
    const Pose difference = pair.T_map_body.inverse() * pair.T_world_body;
    EXPECT_LT(difference.translation().norm(), 1e-4);
    EXPECT_LT(so3_log(difference.linear()).norm(), 1e-4);
  }
}

TEST(Association, LeavesOutPosesBeyondTheTruthAndInItsGaps) {
  Trajectory truth = loop(1.0, 3.0, 10.0);
  const Trajectory later = loop(5.0, 6.0, 10.0);
  truth.insert(truth.end(), later.begin(), later.end());
  const auto association = associate(loop(0.05, 7.05, 10.0), truth);
  EXPECT_EQ(association.pairs.size(), 30U);
  EXPECT_EQ(association.unmatched, 41U);
}

// Straight lines between true poses a second apart would be off by centimetres.
TEST(Association, InterpolatesTheEstimateAtTheTimesOfASparseTruth) {
  const auto association = associate(loop(0.013, 9.9, 10.0), loop(0.5, 12.5, 1.0));
  EXPECT_TRUE(association.interpolates_estimate);
  EXPECT_EQ(association.pairs.size(), 10U);
  EXPECT_EQ(association.unmatched, 3U);
  EXPECT_EQ(association.max_gap, 0.25);
  for (const PosePair& pair : association.pairs) {
    const Pose difference = pair.T_map_body.inverse() * pair.T_world_body;
    EXPECT_LT(difference.translation().norm(), 3e-3);
  }
}

TEST(Association, InterpolatesBetweenPosesThatAreAllFarApartUpToALimit) {
  const Trajectory estimate = loop(0.1, 9.1, 1.0);
  EXPECT_EQ(associate(estimate, loop(0.0, 10.0, 1.0)).pairs.size(), 10U);
  EXPECT_EQ(associate(estimate, loop(0.0, 10.0, 1.0)).max_gap, 1.5);
  EXPECT_EQ(associate(estimate, loop(0.0, 10.0, 1.0), 0.9).pairs.size(), 0U);
  EXPECT_EQ(associate(loop(0.1, 9.1, 0.2), loop(0.0, 10.0, 0.25)).pairs.size(), 0U);
  EXPECT_EQ(associate(loop(0.1, 9.1, 0.2), loop(0.0, 10.0, 0.25), 4.0).pairs.size(), 3U);
}

TEST(Association, SaysWhyNothingIsPaired) {
  const auto shifted = [](double offset) {
    Trajectory trajectory = loop(0.0, 10.0, 10.0);
    for (StampedPose& pose : trajectory) {
      pose.time += offset;
    }
    return trajectory;
  };
  EXPECT_THAT(
      why_unmatched(shifted(1000.0), shifted(1.7e9)),
      ::testing::AllOf(
          ::testing::HasSubstr("from 1000.000 to 1010.000 s (since a start)"),
          ::testing::HasSubstr("from 1700000000.000 to 1700000010.000 s (UNIX time)"),
          ::testing::HasSubstr("--time-offset=-1699999000.000")));
  EXPECT_THAT(
      why_unmatched(shifted(1.7e9), shifted(1.7e18)), ::testing::HasSubstr("in nanoseconds"));
  EXPECT_THAT(why_unmatched(shifted(0.0), shifted(0.05)), ::testing::HasSubstr("--max-gap"));
  EXPECT_THAT(why_unmatched({}, shifted(0.0)), ::testing::HasSubstr("holds no poses"));
}

TEST(Association, LeavesOutPosesThatAreNotNumbers) {
  Trajectory estimate = loop(0.0, 5.0, 10.0);
  estimate[7].pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  estimate[9].time = std::numeric_limits<double>::quiet_NaN();
  Trajectory truth = loop(0.0, 5.0, 10.0);
  truth[20].pose.translation().y() = std::numeric_limits<double>::infinity();
  const auto association = associate(estimate, truth);
  EXPECT_EQ(association.non_finite, 2U);
  EXPECT_EQ(association.pairs.size(), 49U);
  for (const PosePair& pair : association.pairs) {
    EXPECT_TRUE(pair.T_world_body.matrix().allFinite());
  }
}

TEST(Alignment, FindsAnyRigidTransformAndScale) {
  auto random = rng();
  for (int i = 0; i < 50; ++i) {
    const Pose T_map_world = random_pose(random, 3.0, 100.0);
    const Trajectory truth = loop(0.0, 10.0, 10.0);
    const auto rigid = associate(moved(truth, T_map_world), truth);
    const Alignment se3 = align(rigid.pairs, AlignmentKind::kSe3);
    EXPECT_TRUE((se3.T_world_map * T_map_world).matrix().isIdentity(1e-9));
    EXPECT_EQ(se3.scale, 1.0);

    Trajectory scaled = moved(truth, T_map_world);
    for (StampedPose& stamped : scaled) {
      stamped.pose.translation() *= 1.25;
    }
    const auto pairs = associate(scaled, truth).pairs;
    const Alignment sim3 = align(pairs, AlignmentKind::kSim3);
    EXPECT_NEAR(sim3.scale, 0.8, 1e-9);
    EXPECT_LT(summarize(position_errors(pairs, sim3))->max, 1e-9);
    EXPECT_GT(summarize(position_errors(pairs, align(pairs, AlignmentKind::kSe3)))->rmse, 0.1);
  }
}

/// What the alignment cannot take away stays on its axis, and the axes add up to the whole.
TEST(AxisRmse, SplitsTheErrorOfPositions) {
  const Trajectory truth = loop(0.0, 40.0, 10.0);
  Trajectory bent = truth;
  for (std::size_t i = 0; i < bent.size(); ++i) {
    bent[i].pose.translation().z() += i % 2 == 0 ? 0.03 : -0.03;
  }
  const auto pairs = associate(bent, truth).pairs;
  const Alignment alignment = align(pairs, AlignmentKind::kSe3);
  const std::array<double, 3> axes = axis_rmse(pairs, alignment);
  EXPECT_LT(axes[0], 1e-3);
  EXPECT_LT(axes[1], 1e-3);
  EXPECT_NEAR(axes[2], 0.03, 1e-3);
  const double whole = summarize(position_errors(pairs, alignment))->rmse;
  EXPECT_NEAR(std::hypot(axes[0], axes[1], axes[2]), whole, 1e-12);
}

TEST(Alignment, IsRefusedWhereThePositionsLeaveItOpen) {
  const Trajectory truth = loop(0.0, 10.0, 10.0);
  auto pairs = associate(truth, truth).pairs;
  EXPECT_THROW(align({}, AlignmentKind::kSe3), std::runtime_error);
  EXPECT_THROW(align({pairs[0], pairs[1]}, AlignmentKind::kSe3), std::runtime_error);
  for (PosePair& pair : pairs) {
    pair.T_map_body.translation() = Eigen::Vector3d(pair.time, 2.0 * pair.time, 3.0);
  }
  EXPECT_THROW(align(pairs, AlignmentKind::kSe3), std::runtime_error);
  EXPECT_NO_THROW(align(pairs, AlignmentKind::kNone));
  EXPECT_THROW(alignment_kind("se2"), std::invalid_argument);
}

TEST(ErrorStatistics, OfKnownNumbers) {
  const auto odd = summarize({3.0, 1.0, 2.0});
  EXPECT_DOUBLE_EQ(odd->mean, 2.0);
  EXPECT_DOUBLE_EQ(odd->median, 2.0);
  EXPECT_DOUBLE_EQ(odd->max, 3.0);
  EXPECT_DOUBLE_EQ(odd->rmse, std::sqrt(14.0 / 3.0));
  EXPECT_DOUBLE_EQ(summarize({4.0, 1.0, 2.0, 10.0})->median, 3.0);
  EXPECT_FALSE(summarize(std::vector<double>{}).has_value());
}

TEST(RelativeError, IgnoresWhereTheMapFrameIs) {
  auto random = rng();
  const Trajectory truth = loop(0.0, 10.0, 10.0);
  const auto pairs = associate(moved(truth, random_pose(random, 3.0, 10.0)), truth).pairs;
  for (const StepUnit unit : {StepUnit::kFrame, StepUnit::kSecond, StepUnit::kMetre}) {
    const RelativeError error = relative_error(pairs, unit);
    EXPECT_LT(error.translation->max, 1e-9);
    EXPECT_LT(error.rotation_deg->max, 1e-6);
  }
}

TEST(RelativeError, OfASteadyDriftIsTheDriftPerUnit) {
  Trajectory truth;
  Trajectory estimate;
  for (int i = 0; i <= 100; ++i) {
    StampedPose stamped;
    stamped.time = 1e9 + 0.1 * i;
    stamped.pose.translation().x() = 0.05 * i;  // half a metre per second
    truth.push_back(stamped);
    stamped.pose.translation().y() = 0.001 * i;
    estimate.push_back(stamped);
  }
  const auto pairs = associate(estimate, truth).pairs;
  const auto frame = relative_error(pairs, StepUnit::kFrame);
  EXPECT_EQ(frame.translation->count, 100U);
  EXPECT_NEAR(frame.translation->rmse, 0.001, 1e-9);
  const auto second = relative_error(pairs, StepUnit::kSecond);
  EXPECT_EQ(second.translation->count, 91U);
  EXPECT_NEAR(second.translation->mean, 0.01, 1e-9);
  const auto metre = relative_error(pairs, StepUnit::kMetre);
  EXPECT_EQ(metre.translation->count, 81U);
  EXPECT_NEAR(metre.translation->median, 0.02, 1e-9);
}

TEST(RelativeError, IsNothingWhenNoStepIsThatLong) {
  const Trajectory truth = loop(0.0, 0.5, 10.0);
  const auto pairs = associate(truth, truth).pairs;
  EXPECT_TRUE(relative_error(pairs, StepUnit::kFrame).translation.has_value());
  EXPECT_FALSE(relative_error(pairs, StepUnit::kSecond).translation.has_value());
  EXPECT_FALSE(relative_error(pairs, StepUnit::kMetre).rotation_deg.has_value());
}

}  // namespace
}  // namespace nvm::eval
