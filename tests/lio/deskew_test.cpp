// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/deskew.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lio/analytic_motion.hpp"
#include "lio/state/error_state_filter.hpp"
#include "lio/state/motion_along.hpp"

namespace nvm::lio {
namespace {

const test::AnalyticMotion kMotion;

Pose lidar_in_body() {
  Pose T_body_lidar = Pose::Identity();
  T_body_lidar.linear() = so3_exp({0.1, 0.2, -0.3});
  T_body_lidar.translation() = Eigen::Vector3d(0.05, -0.02, 0.1);
  return T_body_lidar;
}

/// Fixed places in the world, seen one after the other from the moving sensor.
Eigen::Vector3d landmark(int i) { return {3.0 + 0.01 * i, 2.0 - 0.02 * i, 0.5 + 0.005 * i}; }

Scan scan_of_landmarks(double t_begin, double t_end) {
  Scan scan{t_begin, t_end, {}};
  for (int i = 0; i < 100; ++i) {
    const double dt = (t_end - t_begin) * i / 99.0;
    const Pose T_world_lidar = kMotion.pose(t_begin + dt) * lidar_in_body();
    const Eigen::Vector3f p = (T_world_lidar.inverse() * landmark(i)).cast<float>();
    scan.points.push_back({p.x(), p.y(), p.z(), 0.0F, static_cast<float>(dt), 0});
  }
  return scan;
}

struct Predicted {
  std::vector<MotionSegment> segments;
  NavState end;
};

Predicted predict(NavState start, double until) {
  ErrorStateFilter filter(start, NavCovariance::Identity(), {});
  Predicted predicted;
  for (double t = start.time; t < until - 1e-9; t += 0.005) {
    predicted.segments.push_back(filter.predict(kMotion.imu(t), kMotion.imu(t + 0.005)));
  }
  predicted.end = filter.state();
  return predicted;
}

NavState start_state(double time) {
  NavState start = kMotion.state(time);
  start.T_body_lidar = lidar_in_body();
  return start;
}

double worst_error(const DeskewedScan& scan, const Pose& T_world_lidar) {
  double worst = 0.0;
  for (int i = 0; i < static_cast<int>(scan.size()); ++i) {
    const Eigen::Vector3d p = scan.points[static_cast<std::size_t>(i)].cast<double>();
    worst = std::max(worst, (T_world_lidar * p - landmark(i)).norm());
  }
  return worst;
}

TEST(Deskew, PutsEveryReturnWhereItIsSeenAtTheScansEnd) {
  const Predicted predicted = predict(start_state(4.0), 4.1);
  DeskewedScan scan;
  deskew(scan_of_landmarks(4.0, 4.1), predicted.segments, predicted.end, {}, scan);
  ASSERT_EQ(scan.size(), 100U);
  EXPECT_LT(worst_error(scan, predicted.end.T_world_lidar()), 5e-5);
  const Eigen::Vector3d first_place =
      predicted.end.T_world_lidar() * scan.viewpoints[0].cast<double>();
  EXPECT_LT((first_place - (kMotion.pose(4.0) * lidar_in_body()).translation()).norm(), 5e-5);
  EXPECT_NEAR(scan.ages.front(), 0.1F, 1e-6F);
  EXPECT_NEAR(scan.ages.back(), 0.0F, 1e-6F);
}

Predicted along(const Trajectory& poses, double begin, double end) {
  Predicted predicted;
  motion_along(poses, begin, end, predicted.segments);
  predicted.end.time = end;
  predicted.end.T_world_body = *pose_at(poses, end);
  predicted.end.T_body_lidar = lidar_in_body();
  return predicted;
}

// A sensor that sways does not go straight from one scan's end to the next one's.
TEST(Deskew, KnownPosesBetweenTheScansEndsAreFollowed) {
  Trajectory often;
  for (int i = 0; i <= 20; ++i) {
    often.push_back({4.0 + 0.01 * i, kMotion.pose(4.0 + 0.01 * i)});
  }
  const auto error = [](const Trajectory& poses) {
    const Predicted predicted = along(poses, 4.0, 4.1);
    DeskewedScan scan;
    deskew(scan_of_landmarks(4.0, 4.1), predicted.segments, predicted.end, {}, scan);
    return worst_error(scan, predicted.end.T_world_lidar());
  };
  EXPECT_LT(error(often), 1e-4);
  EXPECT_GT(error({often.front(), often[10], often.back()}), 1e-3);
}

TEST(Deskew, KnownPosesStandStillBeforeTheFirstAndWithoutTime) {
  const Trajectory poses{{4.05, kMotion.pose(4.05)}, {4.1, kMotion.pose(4.1)}};
  const Predicted late = along(poses, 4.0, 4.1);
  EXPECT_TRUE(late.segments.front().T_world_body.isApprox(kMotion.pose(4.05), 1e-12));
  EXPECT_LT(late.segments.front().velocity.norm(), 1e-12);
  EXPECT_GT(late.segments.back().velocity.norm(), 0.01);
  const Predicted instant = along(poses, 4.1, 4.1);
  ASSERT_EQ(instant.segments.size(), 1U);
  EXPECT_TRUE(instant.segments.front().pose_at(4.1).isApprox(kMotion.pose(4.1), 1e-12));
}

TEST(Deskew, ACorrectedVelocityAndBiasUndoAWrongPrediction) {
  const Scan scan = scan_of_landmarks(4.0, 4.1);
  NavState wrong = start_state(4.0);
  wrong.velocity += Eigen::Vector3d(0.05, -0.04, 0.02);
  wrong.gyro_bias = Eigen::Vector3d(0.01, 0.0, -0.02);
  const Predicted predicted = predict(wrong, 4.1);
  NavState truth = start_state(4.1);
  DeskewedScan deskewed;
  deskew(scan, predicted.segments, predicted.end, {}, deskewed);
  EXPECT_GT(worst_error(deskewed, truth.T_world_lidar()), 2e-3);
  correct_deskew(predicted.end, truth, deskewed);
  EXPECT_LT(worst_error(deskewed, truth.T_world_lidar()), 3e-4);
}

TEST(Deskew, CountsWhatItLeavesOut) {
  Scan scan{0.0, 0.1, {}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  scan.points = {
      {1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0},
      {nan, 0.0F, 0.0F, 0.0F, 0.0F, 0},
      {0.1F, 0.0F, 0.0F, 0.0F, 0.0F, 0},
      {0.0F, 200.0F, 0.0F, 0.0F, 0.0F, 0},
      {1.0F, 0.0F, 0.0F, 0.0F, nan, 0}};
  const Predicted predicted = predict(start_state(0.0), 0.1);
  DeskewedScan deskewed;
  const DeskewStats stats = deskew(scan, predicted.segments, predicted.end, {}, deskewed);
  EXPECT_EQ(deskewed.size(), 1U);
  EXPECT_EQ(stats.non_finite, 2U);
  EXPECT_EQ(stats.out_of_range, 2U);
}

TEST(Deskew, ThinsALargeScan) {
  const Scan scan = scan_of_landmarks(4.0, 4.1);
  const Predicted predicted = predict(start_state(4.0), 4.1);
  DeskewedScan all;
  deskew(scan, predicted.segments, predicted.end, {}, all);
  DeskewedScan thinned;
  deskew(scan, predicted.segments, predicted.end, {0.3, 100.0, 50}, thinned);
  EXPECT_NEAR(static_cast<double>(thinned.size()), 50.0, 15.0);  // a sample of few tells little
  for (std::size_t i = 0, j = 0; i < thinned.size(); ++i, ++j) {
    while (j < all.size() && all.ages[j] != thinned.ages[i]) {
      ++j;
    }
    ASSERT_LT(j, all.size());
    EXPECT_EQ(thinned.points[i], all.points[j]);
    EXPECT_EQ(thinned.viewpoints[i], all.viewpoints[j]);
  }
}

TEST(Deskew, RejectsBadLimits) {
  EXPECT_THROW((ReturnLimits{2.0, 1.0}.validate()), std::invalid_argument);
  EXPECT_THROW((ReturnLimits{1.0, 2.0, 0}.validate()), std::invalid_argument);
}

}  // namespace
}  // namespace nvm::lio
