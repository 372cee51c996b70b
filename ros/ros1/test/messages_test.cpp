// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "messages.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>

namespace nvm_ros {
namespace {

using nvm::Pose;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

Pose pose(const Eigen::Vector3d& rotation, const Eigen::Vector3d& translation) {
  Pose pose = Pose::Identity();
  pose.linear() = nvm::so3_exp(rotation);
  pose.translation() = translation;
  return pose;
}

Frames a_base() {
  Frames frames;
  frames.base = "base_link";
  frames.T_body_base = pose({0.3, -0.2, 0.5}, {0.4, -0.1, 0.2});
  frames.T_body_lidar = pose({0.0, 0.1, 0.0}, {0.0, 0.0, 0.1});
  return frames;
}

nvm::lio::FrameResult a_frame() {
  nvm::lio::FrameResult frame;
  frame.time = 1234.5;
  frame.T_map_body = pose({0.1, 0.7, -0.4}, {3.0, 2.0, 1.0});
  frame.velocity = {1.0, 0.2, -0.3};
  frame.angular_rate = {0.1, 0.2, 0.3};
  return frame;
}

TEST(OdometryMessage, HoldsThePoseOfTheBase) {
  const Frames frames = a_base();
  const nvm::lio::FrameResult frame = a_frame();
  const nav_msgs::Odometry message = odometry_message(frame, frames, "odom");
  const Pose expected = frame.T_map_body * frames.T_body_base;
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "base_link");
  EXPECT_EQ(message.header.stamp.toSec(), 1234.5);
  EXPECT_EQ(message.pose.pose.position.y, expected.translation().y());
  const auto& q = message.pose.pose.orientation;
  EXPECT_TRUE(
      Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix().isApprox(expected.linear()));
}

// Samples errors of the body's pose, and compares with what they do to the base's.
TEST(OdometryMessage, HoldsTheCovarianceOfTheBaseInRosOrder) {
  const Frames frames = a_base();
  nvm::lio::FrameResult frame = a_frame();
  Matrix6 root = Matrix6::Zero();
  for (int i = 0; i < 36; ++i) {
    root(i / 6, i % 6) = 1e-4 * std::sin(1.0 + i);
  }
  frame.pose_covariance = root * root.transpose();
  const nav_msgs::Odometry message = odometry_message(frame, frames, "odom");
  const Pose base = frame.T_map_body * frames.T_body_base;
  Matrix6 expected = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {  // the columns of a root are errors that make up the covariance
    Pose body = frame.T_map_body;
    body.translation() += root.col(i).head<3>();
    body.linear() = nvm::so3_exp(root.col(i).tail<3>()) * body.linear();
    const Pose moved = body * frames.T_body_base;
    Eigen::Matrix<double, 6, 1> error;
    error << moved.translation() - base.translation(),
        nvm::so3_log(moved.linear() * base.linear().transpose());
    expected += error * error.transpose();
  }
  const Matrix6 covariance = Eigen::Map<const Matrix6>(message.pose.covariance.data());
  EXPECT_LT((covariance - expected).norm(), 1e-3 * expected.norm());
}

TEST(OdometryMessage, HoldsTheVelocityOfTheBaseInItsFrame) {
  const Frames frames = a_base();
  const nvm::lio::FrameResult frame = a_frame();
  const nav_msgs::Odometry message = odometry_message(frame, frames, "odom");
  constexpr double kStep = 1e-6;
  Pose body = frame.T_map_body;
  body.translation() += kStep * frame.velocity;
  body.linear() = body.linear() * nvm::so3_exp(kStep * frame.angular_rate);
  const Pose before = frame.T_map_body * frames.T_body_base;
  const Pose motion = before.inverse() * (body * frames.T_body_base);
  EXPECT_NEAR(message.twist.twist.linear.x, motion.translation().x() / kStep, 1e-5);
  EXPECT_NEAR(message.twist.twist.linear.z, motion.translation().z() / kStep, 1e-5);
  EXPECT_NEAR(message.twist.twist.angular.y, nvm::so3_log(motion.linear()).y() / kStep, 1e-5);
}

TEST(OdometryMessage, SurvivesTimesThatRosCannotHold) {
  nvm::lio::FrameResult frame = a_frame();
  for (const double time : {-5.0, 1e12}) {
    frame.time = time;
    EXPECT_NO_THROW(odometry_message(frame, a_base(), "odom"));
  }
}

TEST(PathMessage, IsThinnedToALengthAndEndsWithTheLastPose) {
  nvm::Trajectory trajectory;
  for (int i = 0; i < 1000; ++i) {
    trajectory.push_back({10.0 + i, pose(Eigen::Vector3d::Zero(), {1.0 * i, 0.0, 0.0})});
  }
  const nav_msgs::Path path = path_message(trajectory, "odom", 300);
  EXPECT_LE(path.poses.size(), 300U);
  EXPECT_GE(path.poses.size(), 200U);
  EXPECT_EQ(path.poses.back().pose.position.x, 999.0);
  EXPECT_TRUE(path_message({}, "odom", 300).poses.empty());
}

TEST(MapMessage, HoldsWhatTheMapHasOfEachPoint) {
  nvm::PointValues bright;
  bright.intensity = 90.0F;
  const std::vector<nvm::MapPoint> points = {
      {{1.0, 2.0, 3.0}, {0.0F, 0.0F, 1.0F}, 0, {}},
      {{4.0, 5.0, 6.0}, {0.0F, -1.0F, 0.0F}, 1, bright}};
  for (const bool has_intensity : {false, true}) {
    const sensor_msgs::PointCloud2 cloud = map_message(points, has_intensity, 7.0, "odom");
    ASSERT_EQ(cloud.width, 2U);
    ASSERT_EQ(cloud.data.size(), 2 * cloud.point_step);
    ASSERT_EQ(cloud.fields.size(), has_intensity ? 8U : 7U);
    const auto second = [&](std::size_t field) {
      float value = 0.0F;
      std::memcpy(
          &value, &cloud.data[cloud.point_step + cloud.fields[field].offset], sizeof(value));
      return value;
    };
    EXPECT_EQ(second(1), 5.0F);
    EXPECT_EQ(second(4), -1.0F);
    if (has_intensity) {
      EXPECT_EQ(cloud.fields[6].name, "intensity");
      EXPECT_EQ(second(6), 90.0F);
    }
    EXPECT_EQ(cloud.fields.back().name, "side");
    EXPECT_EQ(cloud.data[cloud.point_step + cloud.fields.back().offset], 1);
  }
}

}  // namespace
}  // namespace nvm_ros
