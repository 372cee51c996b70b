// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "topics.hpp"

#include <gmock/gmock.h>

namespace nvm_ros {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<nvm::io::MessageTopic> kRobot = {
    {"/camera", "sensor_msgs/Image", 0},
    {"/imu", "sensor_msgs/Imu", 0},
    {"/livox/lidar", "livox_ros_driver2/CustomMsg", 0}};

NodeOptions impatient() {
  NodeOptions options;
  options.detection_time = 0.0;
  return options;
}

Topics find(const NodeOptions& options, const std::vector<nvm::io::MessageTopic>& topics) {
  return find_topics(
      options, [&] { return topics; }, [] { return true; });
}

TEST(Topics, AreFoundByTheirTypes) {
  const Topics topics = find(impatient(), kRobot);
  EXPECT_EQ(topics.lidar, "/livox/lidar");
  EXPECT_EQ(topics.imu, "/imu");
  EXPECT_THAT(topics.notes, IsEmpty());
}

TEST(Topics, ThatAreNamedNeedNotExistYet) {
  NodeOptions options = impatient();
  options.input.lidar_topic = "/points";
  options.input.imu_topic = "/imu/data";
  const Topics topics = find(options, {});
  EXPECT_EQ(topics.lidar, "/points");
  EXPECT_EQ(topics.imu, "/imu/data");
}

TEST(Topics, AreWaitedFor) {
  int asked = 0;
  const Topics topics = find_topics(
      impatient(),
      [&] { return ++asked < 3 ? std::vector<nvm::io::MessageTopic>{} : kRobot; },
      [] { return true; });
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(topics.lidar, "/livox/lidar");
}

TEST(Topics, AreSaidWhenThereIsAChoice) {
  std::vector<nvm::io::MessageTopic> topics = kRobot;
  topics.push_back({"/points", "sensor_msgs/PointCloud2", 0});
  const Topics found = find(impatient(), topics);
  EXPECT_EQ(found.lidar, "/livox/lidar");
  EXPECT_THAT(found.notes, Contains(HasSubstr("/livox/lidar, /points: set lidar_topic")));
}

TEST(Topics, WithoutAnImuMeanScansAlone) {
  const std::vector<nvm::io::MessageTopic> clouds = {{"/points", "sensor_msgs/PointCloud2", 0}};
  EXPECT_THAT(find(impatient(), clouds).notes, Contains(HasSubstr("no IMU topic")));
  NodeOptions options = impatient();
  options.input.imu_topic = "none";
  const Topics found = find(options, kRobot);
  EXPECT_EQ(found.imu, "");
  EXPECT_THAT(found.notes, IsEmpty());
}

}  // namespace
}  // namespace nvm_ros
