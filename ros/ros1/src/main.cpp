// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "config/schema.hpp"
#include "node.hpp"

namespace {

std::string default_parameters() {
  nvm_ros::NodeOptions options;
  nvm::config::Schema schema;
  nvm_ros::bind(schema, options);
  return schema.to_yaml();
}

void run(const nvm_ros::NodeOptions& options) {
  nvm_ros::Node node(options);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  options.mode == nvm_ros::Mode::kOnline ? node.run_online() : node.run_offline();
  spinner.stop();
}

}  // namespace

int main(int argc, char** argv) {
  if (std::any_of(argv + 1, argv + argc, [](const std::string& word) {
        return word == "--print-config";
      })) {
    fmt::print("{}", default_parameters());
    return 0;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // lines reach a log file at once
  ros::init(argc, argv, "nvm_odometry");
  const ros::NodeHandle keeps_ros_alive;  // which ends, its log included, with the last handle
  try {
    run(nvm_ros::read_parameters());
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
