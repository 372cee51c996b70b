// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/lidar_odometry.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm::lio {
namespace {

// Turns by `yaw` [rad] at `position`.
Pose pose(double yaw, const Eigen::Vector3d& position) {
  Pose result = Pose::Identity();
  result.linear() = so3_exp({0.0, 0.0, yaw});
  result.translation() = position;
  return result;
}

LidarOdometryOptions lidar_only_options() {
  LidarOdometryOptions options;
  options.normals.min_radius = 0.35;  // the test's scans are sparse
  options.normals.max_radius = 0.5;
  options.keypoints.max_count = 800;
  options.align.association.neighbors = 10;
  return options;
}

class LidarOdometryTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kPoints = 6000;

  std::unique_ptr<LidarOdometry> odometry(
      const LidarOdometryOptions& options = lidar_only_options(), int threads = 1) const {
    MapOptions map;
    map.min_point_distance = 0.05;
    return std::make_unique<LidarOdometry>(
        options, make_map(MapType::kNvm, map), Executor(threads));
  }

  Scan scan(double time, const Pose& T_map_lidar) {
    const test::RoomScan seen = room_.scan(T_map_lidar, kPoints, 0.005, rng_);
    Scan result{time, time, {}};
    for (const Eigen::Vector3f& point : seen.points) {
      result.points.push_back({point.x(), point.y(), point.z()});
    }
    return result;
  }

  // A sweep over [time - 0.1, time] during which the LiDAR moves.
  template <class Motion>
  Scan sweep(double time, const Motion& T_map_lidar) {
    constexpr std::size_t kParts = 50;
    Scan result{time - 0.1, time, {}};
    for (std::size_t part = 0; part < kParts; ++part) {
      const double dt = 0.1 * static_cast<double>(part) / kParts;
      const Pose T = T_map_lidar(result.t_begin + dt);
      for (const Eigen::Vector3f& p : room_.scan(T, kPoints / kParts, 0.005, rng_).points) {
        result.points.push_back({p.x(), p.y(), p.z(), 0.0F, static_cast<float>(dt)});
      }
    }
    return result;
  }

  static double distance(const Pose& a, const Pose& b) {
    return (a.translation() - b.translation()).norm();
  }

  std::mt19937_64 rng_ = test::rng();
  test::Room room_;
};

TEST_F(LidarOdometryTest, FollowsAWalkAndMapsBothSidesOfThePartition) {
  const auto odometry = this->odometry();
  const Pose start = pose(0.0, {-2.5, 2.0, 0.0});
  for (int k = 0; k <= 40; ++k) {
    const double s = 0.1 * k;  // past the end of the partition to its other side
    const Pose truth = pose(0.3 * s, {-2.5 + s, 2.0 - 2.0 * std::sin(0.8 * s), 0.05 * s});
    const FrameResult frame = odometry->process(scan(s, truth));
    ASSERT_EQ(frame.status, FrameStatus::kTracking) << "scan " << k;
    ASSERT_LT(distance(frame.T_map_body, start.inverse() * truth), 0.03) << "scan " << k;
  }
  EXPECT_GT(odometry->map().voxel_map()->stats().two_sided_voxels, 50U);
}

TEST_F(LidarOdometryTest, FollowsSuddenTurnsAtALowRate) {
  const auto odometry = this->odometry();
  double yaw = 0.0;
  int sign = 1;
  odometry->process(scan(0.0, pose(yaw, Eigen::Vector3d::Zero())));
  for (int k = 1; k <= 12; ++k) {
    yaw += sign * 0.7;
    sign = k % 3 == 0 ? -sign : sign;
    const Pose truth = pose(yaw, {0.4 * std::sin(1.0 * k), -0.4 * std::sin(0.7 * k), 0.0});
    const FrameResult frame = odometry->process(scan(0.5 * k, truth));
    ASSERT_EQ(frame.status, FrameStatus::kTracking) << "scan " << k;
    ASSERT_LT(distance(frame.T_map_body, truth), 0.05) << "scan " << k;
  }
}

TEST_F(LidarOdometryTest, DeskewsASweepMadeInMotion) {
  const auto odometry = this->odometry();
  const auto truth = [](double t) {
    const double moving = std::max(0.0, t);
    return pose(1.0 * moving, {0.8 * moving, 0.0, 0.0});
  };
  for (int k = 0; k <= 15; ++k) {
    const FrameResult frame = odometry->process(sweep(0.1 * k, truth));
    ASSERT_EQ(frame.status, FrameStatus::kTracking) << "scan " << k;
    // Nothing yet says how fast the first moving sweep moved: up to 8 cm while it was made.
    const double bound = k == 1 ? 0.08 : 0.04;
    ASSERT_LT(distance(frame.T_map_body, truth(0.1 * k)), bound) << "scan " << k;
  }
}

TEST_F(LidarOdometryTest, PosesAreThoseOfTheBody) {
  LidarOdometryOptions options = lidar_only_options();
  options.T_body_lidar = pose(1.0, {0.1, 0.2, 0.3});
  const auto odometry = this->odometry(options);
  for (int k = 0; k <= 5; ++k) {
    const Pose T_map_body = pose(0.05 * k, {0.1 * k, 0.0, 0.0});
    const FrameResult frame = odometry->process(scan(0.1 * k, T_map_body * options.T_body_lidar));
    EXPECT_LT(distance(frame.T_map_body, T_map_body), 0.02);
    EXPECT_TRUE(frame.T_map_lidar.isApprox(frame.T_map_body * options.T_body_lidar));
  }
}

TEST_F(LidarOdometryTest, SameBitsForAnyNumberOfThreads) {
  const auto serial = odometry();
  const auto parallel = odometry(lidar_only_options(), 3);
  for (int k = 0; k <= 5; ++k) {
    const Scan next = scan(0.5 * k, pose(0.4 * k, {0.3 * std::sin(k), 0.2 * k - 0.5, 0.0}));
    const FrameResult a = serial->process(next);
    const FrameResult b = parallel->process(next);
    ASSERT_EQ(a.T_map_body.matrix(), b.T_map_body.matrix()) << "scan " << k;
    ASSERT_EQ(a.residuals, b.residuals);
    ASSERT_EQ(a.inserted.stored, b.inserted.stored);
  }
}

TEST_F(LidarOdometryTest, BlindnessIsReportedAndSpoilsNothing) {
  const auto odometry = this->odometry();
  const Pose still = Pose::Identity();
  EXPECT_EQ(odometry->process(Scan{0.0, 0.0, {}}).status, FrameStatus::kSkipped);
  EXPECT_EQ(
      odometry->process(Scan{0.1, 0.1, {{1.0F, 0.0F, 0.0F}}}).status, FrameStatus::kInitializing);
  for (int k = 2; k < 5; ++k) {
    EXPECT_EQ(odometry->process(scan(0.1 * k, still)).status, FrameStatus::kTracking);
  }
  const std::size_t size = odometry->map().size();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Scan blind{0.5, 0.5, std::vector<TimedPoint>(2000, TimedPoint{nan, nan, nan})};
  EXPECT_EQ(odometry->process(blind).status, FrameStatus::kWeak);
  blind.t_begin = blind.t_end = 5.0;
  const FrameResult lost = odometry->process(blind);
  EXPECT_EQ(lost.status, FrameStatus::kLost);
  EXPECT_FALSE(lost.message.empty());
  EXPECT_EQ(odometry->process(scan(4.0, still)).status, FrameStatus::kSkipped);
  EXPECT_EQ(odometry->map().size(), size);

  const FrameResult found = odometry->process(scan(6.0, still));
  EXPECT_EQ(found.status, FrameStatus::kTracking);
  EXPECT_LT(distance(found.T_map_body, still), 0.02);
}

TEST_F(LidarOdometryTest, AScanOfAnotherPlaceIsNotBelieved) {
  const auto odometry = this->odometry();
  odometry->process(scan(0.0, Pose::Identity()));
  const std::size_t size = odometry->map().size();
  std::uniform_real_distribution<float> uniform(-40.0F, 40.0F);
  Scan elsewhere{0.1, 0.1, {}};
  for (std::size_t i = 0; i < kPoints; ++i) {  // the inside of a dome of 30 m
    Eigen::Vector3f direction(uniform(rng_), uniform(rng_), std::abs(uniform(rng_)));
    direction = 30.0F * direction.normalized();
    elsewhere.points.push_back({direction.x(), direction.y(), direction.z()});
  }
  EXPECT_NE(odometry->process(elsewhere).status, FrameStatus::kTracking);
  EXPECT_EQ(odometry->map().size(), size);
}

TEST(LidarOdometryOptions, RefusesWhatMakesNoSense) {
  const auto refuses = [](auto change) {
    LidarOdometryOptions options;
    change(options);
    try {
      options.validate();
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refuses([](auto&) {}));
  EXPECT_TRUE(refuses([](auto& o) { o.min_confident_share = 1.5; }));
  EXPECT_TRUE(refuses([](auto& o) { o.max_confident_motion = 0.0; }));
  EXPECT_TRUE(refuses([](auto& o) { o.min_inlier_share = -0.1; }));
  EXPECT_TRUE(refuses([](auto& o) { o.max_weak_duration = -1.0; }));
  EXPECT_TRUE(refuses([](auto& o) { o.T_body_lidar.linear() *= 2.0; }));
  EXPECT_TRUE(refuses([](auto& o) { o.search.voxel_size = 0.0; }));
  EXPECT_TRUE(refuses([](auto& o) { o.search.keypoint_spacing = 0.0; }));
  EXPECT_TRUE(refuses([](auto& o) { o.search.turn = 4.0; }));
}

}  // namespace
}  // namespace nvm::lio
