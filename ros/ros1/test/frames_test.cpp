// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "frames.hpp"

#include <gmock/gmock.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <stdexcept>

namespace nvm_ros {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Says that `child` is `x` [m] along the x axis of `parent`, turned by half a turn about z.
void add(tf2::BufferCore& tf, const std::string& parent, const std::string& child, double x) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.rotation.z = 1.0;
  tf.setTransform(transform, "test", true);
}

NodeOptions impatient() {
  NodeOptions options;
  options.tf_timeout = 0.0;
  return options;
}

TEST(Frames, ComeFromTf) {
  tf2::BufferCore tf;
  add(tf, "base_link", "imu", 1.0);
  add(tf, "imu", "lidar", 0.25);
  const Frames frames = find_frames(tf, "lidar", "/imu", impatient());
  EXPECT_EQ(frames.base, "base_link");
  EXPECT_NEAR(frames.T_body_lidar.translation().x(), 0.25, 1e-12);
  EXPECT_NEAR(frames.T_body_base.translation().x(), 1.0, 1e-12);  // turned by half a turn
  EXPECT_THAT(frames.notes, IsEmpty());
}

TEST(Frames, AreTheSensorsOwnWithoutTf) {
  const tf2::BufferCore tf;
  const Frames alone = find_frames(tf, "lidar", std::nullopt, impatient());
  EXPECT_EQ(alone.base, "lidar");
  EXPECT_THAT(alone.notes, IsEmpty());
  const Frames same = find_frames(tf, "livox_frame", "livox_frame", impatient());
  EXPECT_EQ(same.base, "livox_frame");
  EXPECT_THAT(same.notes, IsEmpty());
  const Frames nameless = find_frames(tf, "", std::nullopt, impatient());
  EXPECT_EQ(nameless.base, "base_link");
}

TEST(Frames, SayWhatIsAssumed) {
  const tf2::BufferCore tf;
  NodeOptions options = impatient();
  options.base_frame = "base_footprint";
  const Frames frames = find_frames(tf, "lidar", "imu", options);
  EXPECT_EQ(frames.base, "base_footprint");
  EXPECT_THAT(frames.notes, Contains(HasSubstr("set T_imu_lidar")));
  EXPECT_THAT(frames.notes, Contains(HasSubstr("base_footprint")));
}

TEST(Frames, TakeTheExtrinsicOfTheParameter) {
  tf2::BufferCore tf;
  NodeOptions options = impatient();
  options.input.T_imu_lidar = {0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  EXPECT_THAT(find_frames(tf, "lidar", "imu", options).notes, IsEmpty());
  EXPECT_EQ(find_frames(tf, "same", "same", options).T_body_lidar.translation().x(), 0.5);
  EXPECT_THAT(find_frames(tf, "same", "same", options).notes, IsEmpty());
  add(tf, "imu", "lidar", 0.25);
  const Frames frames = find_frames(tf, "lidar", "imu", options);
  EXPECT_EQ(frames.T_body_lidar.translation().x(), 0.5);
  EXPECT_THAT(frames.notes, Contains(HasSubstr("TF says")));
  options.input.T_imu_lidar = {1.0, 2.0};
  EXPECT_THROW(find_frames(tf, "lidar", "imu", options), std::invalid_argument);
}

TEST(Frames, EndTheTreeBelowOdomThatSomebodyPublishes) {
  tf2::BufferCore tf;
  add(tf, "odom", "base_link", 3.0);
  add(tf, "base_link", "imu", 1.0);
  EXPECT_EQ(find_frames(tf, "imu", "imu", impatient()).base, "base_link");
}

TEST(Frames, RefuseOneNameForOdomAndBase) {
  const tf2::BufferCore tf;
  EXPECT_THROW(find_frames(tf, "odom", std::nullopt, impatient()), std::invalid_argument);
}

}  // namespace
}  // namespace nvm_ros
