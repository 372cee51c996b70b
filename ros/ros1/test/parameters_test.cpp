// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <filesystem>

#include "config/schema.hpp"
#include "node_options.hpp"
#include "parameter_yaml.hpp"

namespace nvm_ros {
namespace {

NodeOptions read(XmlRpc::XmlRpcValue& parameters) {
  NodeOptions options;
  nvm::config::Schema schema;
  bind(schema, options);
  schema.read_text(to_yaml(parameters), "parameters");
  return options;
}

TEST(Parameters, OfAllTypesReachTheOptions) {
  XmlRpc::XmlRpcValue parameters;
  parameters["lidar_topic"] = "/a \"quoted\" topic";
  parameters["publish_tf"] = false;
  parameters["queue_size"] = 3;
  parameters["map"]["voxel_size"] = 0.123456789012345;
  for (int i = 0; i < 7; ++i) {
    parameters["T_imu_lidar"][i] = i == 6 ? 1.0 : 0.0;
  }
  const NodeOptions options = read(parameters);
  EXPECT_EQ(options.input.lidar_topic, "/a \"quoted\" topic");
  EXPECT_FALSE(options.publish_tf);
  EXPECT_EQ(options.queue_size, 3U);
  EXPECT_EQ(options.pipeline.map.voxel_size, 0.123456789012345);
  EXPECT_EQ(options.input.T_imu_lidar.size(), 7U);
}

TEST(Parameters, OfACommandLineMayBeLists) {
  XmlRpc::XmlRpcValue parameters;
  parameters["T_imu_lidar"] = "[0, 0, 0.5, 0, 0, 0, 1]";
  EXPECT_EQ(read(parameters).input.T_imu_lidar[2], 0.5);
}

TEST(Parameters, ThatAreUnknownAreRefusedWithTheNearestName) {
  XmlRpc::XmlRpcValue parameters;
  parameters["lidar_topik"] = "/x";
  try {
    read(parameters);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("lidar_topic"));
  }
}

TEST(Parameters, OfEachSensorAreAccepted) {
  std::size_t files = 0;
  const std::string folder = std::string(NVM_SOURCE_DIR) + "/ros/ros1/config";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    NodeOptions options;
    nvm::config::Schema schema;
    bind(schema, options);
    EXPECT_NO_THROW(schema.read_file(entry.path())) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 6U);
}

}  // namespace
}  // namespace nvm_ros
