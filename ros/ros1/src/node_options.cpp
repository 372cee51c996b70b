// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "node_options.hpp"

#include <ros/node_handle.h>

#include "config/schema.hpp"
#include "io/sequence/sequence_options.hpp"
#include "parameter_yaml.hpp"

namespace nvm_ros {

void bind(nvm::config::Schema& schema, NodeOptions& options) {
  schema.add_choice<Mode>(
      "mode",
      options.mode,
      {{"online", Mode::kOnline}, {"offline", Mode::kOffline}},
      "From topics as they come, or from a bag as fast as it can be read");
  schema.add("bag", options.bag, "Of offline mode: a ROS 1 bag");
  schema.add(
      "lidar_topic",
      options.input.lidar_topic,
      "PointCloud2, or CustomMsg of either Livox driver; empty: the first that there is");
  schema.add(
      "imu_topic",
      options.input.imu_topic,
      "Imu; empty: the first that there is; none: odometry from scans alone");
  schema.add(
      "T_imu_lidar",
      options.input.T_imu_lidar,
      "x y z [m] qx qy qz qw; empty: from TF, by the frames in the messages");
  schema.add(
      "detection_time",
      options.detection_time,
      {0.0, 3600.0},
      "How long an IMU topic is waited for once there is a LiDAR topic [s]");
  schema.add(
      "queue_size",
      options.queue_size,
      {1.0, 1000.0},
      "Scans that wait at most; when there are more, the oldest is dropped");
  schema.add(
      "imu_timeout",
      options.imu_timeout,
      {0.0, 60.0},
      "An IMU that lets a scan wait for longer has fallen silent [s]");
  schema.add("odom_frame", options.odom_frame, "Where odometry and map are given in");
  schema.add(
      "base_frame",
      options.base_frame,
      "What moves in it; empty: the root of the tree in TF that the IMU (or LiDAR) belongs to");
  schema.add("publish_tf", options.publish_tf, "odom_frame -> base_frame");
  schema.add(
      "tf_timeout", options.tf_timeout, {0.0, 60.0}, "How long the first scan waits for TF [s]");
  schema.add("map_period", options.map_period, {0.0, 3600.0}, "Between two maps [s]; 0: no map");
  schema.add("save_folder", options.save_folder, "Of the save service; empty: nvm in ~/.ros");
  schema.add("exit_when_done", options.exit_when_done, "After the bag of offline mode");
  nvm::io::bind(schema.section("input", "How to read the messages"), options.input);
  nvm::lio::bind(schema, options.pipeline);
}

NodeOptions read_parameters() {
  NodeOptions options;
  nvm::config::Schema schema;
  bind(schema, options);
  const ros::NodeHandle handle("~");
  XmlRpc::XmlRpcValue parameters;
  if (handle.getParam(handle.getNamespace(), parameters)) {
    schema.read_text(to_yaml(parameters), "parameters of " + handle.getNamespace());
  }
  return options;
}

}  // namespace nvm_ros
