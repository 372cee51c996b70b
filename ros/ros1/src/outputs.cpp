// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "outputs.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "messages.hpp"

namespace nvm_ros {

namespace {

constexpr std::size_t kMaxPathLength = 5000;
constexpr std::size_t kMaxPoses = 1'000'000;
constexpr std::chrono::seconds kPathPeriod{1};
/// Making maps takes at most about this share of the time.
constexpr int kMapShare = 20;

/// Nodes that have subscribed to `topic`, as the master knows.
std::size_t listeners_of(const std::string& topic) {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, false)) {
    return 0;
  }
  XmlRpc::XmlRpcValue& subscribers = state[1];  // of (topic, nodes)
  for (int i = 0; i < subscribers.size(); ++i) {
    if (static_cast<std::string&>(subscribers[i][0]) == topic) {
      return static_cast<std::size_t>(subscribers[i][1].size());
    }
  }
  return 0;
}

}  // namespace

bool has_pose(const nvm::lio::FrameResult& frame) {
  using nvm::lio::FrameStatus;
  return frame.status != FrameStatus::kInitializing && frame.status != FrameStatus::kLost &&
         frame.status != FrameStatus::kSkipped;
}

Outputs::Outputs(ros::NodeHandle handle, const NodeOptions& options) : options_(options) {
  const std::uint32_t unlimited = 0;  // what a bag of one length makes has an end
  odometry_ = handle.advertise<nav_msgs::Odometry>(
      "nvm/odometry", options.mode == Mode::kOffline ? unlimited : 1000);
  path_ = handle.advertise<nav_msgs::Path>("nvm/path", 1, true);
  frame_ = handle.advertise<sensor_msgs::PointCloud2>("nvm/frame", 5);
  map_ = handle.advertise<sensor_msgs::PointCloud2>("nvm/map", 1, true);
  status_ = handle.advertise<diagnostic_msgs::DiagnosticArray>("nvm/status", 10);
}

void Outputs::publish(
    const nvm::lio::FrameResult& frame, const nvm::lio::Pipeline& pipeline, const Frames& frames) {
  if (!has_pose(frame)) {
    return;
  }
  const nav_msgs::Odometry odometry = odometry_message(frame, frames, options_.odom_frame);
  odometry_.publish(odometry);
  if (options_.publish_tf) {
    tf_.sendTransform(transform_message(odometry));
  }
  remember({frame.time, frame.T_map_body * frames.T_body_base});
  if (frame_.getNumSubscribers() > 0) {
    frame_.publish(frame_message(pipeline, frame.time, frames));
  }
  const Clock::time_point now = Clock::now();
  if (path_.getNumSubscribers() > 0 && now >= next_path_) {
    publish_path();
  }
  if (options_.map_period > 0.0 && map_.getNumSubscribers() > 0 && now >= next_map_) {
    publish_map(pipeline);
  }
}

void Outputs::publish_all(const nvm::lio::Pipeline& pipeline) {
  publish_path();
  if (options_.map_period > 0.0) {
    publish_map(pipeline);
  }
}

void Outputs::publish(const diagnostic_msgs::DiagnosticStatus& status) {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  array.status.push_back(status);
  status_.publish(array);
}

void Outputs::wait_for_listeners() const {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(10.0);
  const auto is_connected = [](const ros::Publisher& publisher) {
    return publisher.getNumSubscribers() >= listeners_of(publisher.getTopic());
  };
  for (const ros::Publisher* publisher : {&odometry_, &path_, &frame_, &map_, &status_}) {
    while (ros::ok() && !is_connected(*publisher) && ros::WallTime::now() < deadline) {
      ros::WallDuration(0.05).sleep();
    }
  }
}

void Outputs::publish_path() {
  path_.publish(path_message(trajectory_, options_.odom_frame, kMaxPathLength));
  next_path_ = Clock::now() + kPathPeriod;
}

void Outputs::publish_map(const nvm::lio::Pipeline& pipeline) {
  const Clock::time_point begin = Clock::now();
  const double time = trajectory_.empty() ? 0.0 : trajectory_.back().time;
  const nvm::lio::LioMap& map = pipeline.map();
  map_.publish(map_message(map.points(), map.columns().intensity, time, options_.odom_frame));
  const Clock::time_point end = Clock::now();
  const auto period = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(options_.map_period));
  next_map_ = end + std::max(period, kMapShare * (end - begin));
}

void Outputs::remember(const nvm::StampedPose& pose) {
  if (trajectory_.size() >= kMaxPoses) {
    for (std::size_t i = 0; 2 * i < trajectory_.size(); ++i) {
      trajectory_[i] = trajectory_[2 * i];
    }
    trajectory_.resize((trajectory_.size() + 1) / 2);
  }
  trajectory_.push_back(pose);
}

}  // namespace nvm_ros
