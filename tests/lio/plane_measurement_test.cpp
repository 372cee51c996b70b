// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/plane_measurement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::lio {
namespace {

/// A scan in a room whose map has noise, by a body that moves and a LiDAR off its centre. The
/// measurement is made one keypoint at a time, so that its information is that of one residual.
class PlaneMeasurementTest : public ::testing::Test {
 protected:
  PlaneMeasurementTest() : map_(make_map(MapType::kNvm, {})) {
    NavState truth;
    truth.T_world_body.linear() = so3_exp({0.1, -0.2, 0.7});
    truth.T_world_body.translation() << 0.3, -0.4, 0.2;
    truth.T_body_lidar.linear() = so3_exp({0.4, 0.1, -0.9});
    truth.T_body_lidar.translation() << 0.2, -0.1, 0.3;
    truth.velocity = {1.5, -0.8, 0.4};
    truth.gyro_bias = {0.01, -0.02, 0.03};
    const test::RoomScan mapped = room_.scan(truth.T_world_lidar(), 40'000, 0.004, rng_);
    map_->insert(
        mapped.points,
        mapped.normals,
        std::vector<PointValues>(mapped.points.size()),
        truth.T_world_lidar());
    const test::RoomScan seen = room_.scan(truth.T_world_lidar(), 60, 0.004, rng_);
    std::uniform_real_distribution<float> age(0.0F, 0.1F);
    scan_.points = seen.points;
    scan_.viewpoints.assign(seen.points.size(), Eigen::Vector3f::Zero());
    normals_ = seen.normals;
    for (std::size_t i = 0; i < scan_.size(); ++i) {
      scan_.ages.push_back(age(rng_));
    }
    predicted_ = truth;
    // The bias of the prediction: the Jacobian is exact there.
    NavVector error = NavVector::Zero();
    error.segment<3>(kPosition) = Eigen::Vector3d(0.01, -0.02, 0.015);
    error.segment<3>(kVelocity) = Eigen::Vector3d(0.05, 0.04, -0.06);
    state_ = boxplus(predicted_, error);
  }

  /// Calls check(measurement) for each keypoint that finds a plane, associated at `state_`.
  template <class Check>
  void for_each_residual(const MeasurementOptions& options, const Check& check) {
    int valid = 0;
    for (std::uint32_t i = 0; i < scan_.size(); ++i) {
      PlaneMeasurement measurement(options, Executor());
      measurement.start(scan_, normals_, {i}, predicted_);
      measurement.associate(*map_, state_);
      if (measurement.residuals()[0].valid) {
        ++valid;
        check(measurement);
      }
    }
    EXPECT_GT(valid, 30);
  }

  /// Of the point from its plane, at `state`.
  static double distance(PlaneMeasurement& measurement, const NavState& state) {
    Information unused;
    measurement.linearize(state, unused);
    return measurement.residuals()[0].distance;
  }

  std::mt19937_64 rng_ = test::rng();
  test::Room room_;
  std::unique_ptr<LioMap> map_;
  DeskewedScan scan_;
  std::vector<Eigen::Vector3f> normals_;
  NavState predicted_, state_;
};

TEST_F(PlaneMeasurementTest, GradientIsThatOfTheDistanceInEveryPartOfTheState) {
  for_each_residual({}, [&](PlaneMeasurement& measurement) {
    Information information;
    measurement.linearize(state_, information);
    const double z = measurement.residuals()[0].distance;
    MeasuredVector slope;
    for (int i = 0; i < kMeasuredSize; ++i) {
      constexpr double kStep = 1e-5;
      const NavVector e = kStep * NavVector::Unit(i);
      slope[i] =
          (distance(measurement, boxplus(state_, e)) - distance(measurement, boxplus(state_, -e))) /
          (2.0 * kStep);
    }
    // The plane's normal is a unit vector and the slope along the position.
    const double weight = information.matrix.topLeftCorner<3, 3>().trace();
    EXPECT_LT((information.vector / (weight * z) - slope).norm(), 1e-6 * slope.norm());
    EXPECT_LT(
        (information.matrix / weight - slope * slope.transpose()).norm(),
        1e-6 * slope.squaredNorm());
  });
}

TEST_F(PlaneMeasurementTest, APlaneIsLessCertainFarFromItsNeighbours) {
  const MeasurementOptions options;
  std::array<Neighbor, kMaxNeighbors> found;
  LioMap::QueryContext context;
  double farthest = 1.0;
  for_each_residual(options, [&](PlaneMeasurement& measurement) {
    const PlaneResidual& r = measurement.residuals()[0];
    // As the point lies at the state, by its distance along the normal and the map's own answer.
    const double tau = static_cast<double>(r.age);
    const Eigen::Vector3d moved =
        tau * (predicted_.T_world_body.linear().transpose() * predicted_.velocity);
    const Eigen::Vector3d point =
        state_.T_world_body * Eigen::Vector3d(state_.T_body_lidar * r.p_lidar + moved) -
        tau * state_.velocity;
    const Eigen::Vector3f n_map = state_.T_world_lidar().linear().cast<float>() * r.n_lidar;
    const std::size_t count = map_->nearest(
        point, n_map, {options.neighbors, options.max_neighbor_distance}, found.data(), context);
    const Plane plane = *fit_plane(found.data(), count);
    const Eigen::Vector3d offset = point - plane.centroid;
    const double along = offset.cross(plane.normal).squaredNorm();
    const double lever = 1.0 + along / std::pow(plane.deviation[1], 2);
    const double scatter = std::pow(plane.deviation[0], 2) / (static_cast<double>(count) - 2.0);
    EXPECT_NEAR(r.plane_variance, scatter * lever, 1e-6 * r.plane_variance);
    farthest = std::max(farthest, lever);
  });
  EXPECT_GT(farthest, 1.2);
}

// Huber's weight: one within `huber` standard deviations, beyond them one over the excess.
TEST_F(PlaneMeasurementTest, ResidualsBeyondHuberPullLess) {
  MeasurementOptions square;
  square.huber = 1e9;
  MeasurementOptions huber;
  huber.huber = 0.5;
  std::size_t beyond = 0;
  for_each_residual(square, [&](PlaneMeasurement& measurement) {
    const PlaneResidual& r = measurement.residuals()[0];
    Information whole;
    measurement.linearize(state_, whole);
    PlaneMeasurement robust(huber, Executor());
    for (std::uint32_t i = 0; i < scan_.size(); ++i) {
      if (scan_.points[i].cast<double>() == r.p_lidar) {
        robust.start(scan_, normals_, {i}, predicted_);
      }
    }
    robust.associate(*map_, state_);
    Information part;
    robust.linearize(state_, part);
    const double weight = whole.matrix.topLeftCorner<3, 3>().trace();
    const double sigma = r.planarity / std::sqrt(weight * square.correlation);
    const double excess = std::abs(r.distance) / (0.5 * sigma);
    beyond += excess > 1.0 ? 1U : 0U;
    const double robust_weight = part.matrix.topLeftCorner<3, 3>().trace();
    EXPECT_NEAR(robust_weight, weight / std::max(1.0, excess), 1e-9 * weight);
  });
  EXPECT_GT(beyond, 10U);
}

}  // namespace
}  // namespace nvm::lio
