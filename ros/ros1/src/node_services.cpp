// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>
#include <ros/console.h>

#include <cstdlib>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "io/result/map_files.hpp"
#include "io/result/result_folder.hpp"
#include "io/sequence/trajectory_io.hpp"
#include "node.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm_ros {

namespace {

/// Where ROS programs keep their files.
std::string ros_home() {
  if (const char* const home = std::getenv("ROS_HOME")) {
    return home;
  }
  const char* const user = std::getenv("HOME");
  return std::string(user != nullptr ? user : ".") + "/.ros";
}

}  // namespace

bool Node::save(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  const std::string folder =
      options_.save_folder.empty() ? ros_home() + "/nvm" : options_.save_folder;
  try {
    response.message = save_to(folder);
    response.success = 1;
  } catch (const std::exception& error) {
    response.message = error.what();
    response.success = 0;
  }
  ROS_INFO("save: %s", response.message.c_str());
  return true;
}

// Copies under the lock, and writes the larger files without: odometry goes on meanwhile.
std::string Node::save_to(const std::string& folder) {
  std::vector<nvm::MapPoint> points;
  nvm::Trajectory trajectory;
  std::unique_lock lock(mutex_);
  if (!odometry_ || outputs_.trajectory().empty()) {
    throw std::runtime_error("there is no pose yet");
  }
  nvm::io::ResultFolder results(folder);
  const nvm::lio::LioMap& map = odometry_->pipeline().map();
  if (map.voxel_map() != nullptr) {
    nvm::save_map(*map.voxel_map(), results.path() + "/map.nvm");
  }
  points = map.points();
  const nvm::MapColumns columns = map.columns();
  trajectory = outputs_.trajectory();
  lock.unlock();
  const nvm::io::MapCloud cloud = nvm::io::map_cloud_of(points, columns, Eigen::Vector3d::Zero());
  nvm::io::write_map_cloud(results.path() + "/map.ply", cloud);
  nvm::io::write_tum(results.path() + "/trajectory.tum", trajectory);
  results.publish();
  return fmt::format("{}: {} map points, {} poses", folder, points.size(), trajectory.size());
}

bool Node::reset(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  const std::lock_guard lock(mutex_);
  begin_anew("reset was asked for");
  response.success = 1;
  return true;
}

std::string Node::finding(const QueueStats& queue) {
  constexpr int kSilentReports = 2;
  silent_reports_ = queue.clouds == reported_clouds_ ? silent_reports_ + 1 : 0;
  reported_clouds_ = queue.clouds;
  const std::lock_guard lock(received_mutex_);
  if (!type_finding_.empty()) {
    return type_finding_;
  }
  if (silent_reports_ >= kSilentReports) {
    return fmt::format("no message on {} for {} s", topics_.lidar, silent_reports_);
  }
  if (queue.imu_is_silent) {
    return fmt::format("no message on {} any longer", topics_.imu);
  }
  return clock_finding_;
}

void Node::report() {
  const QueueStats queue = queue_->stats();
  const std::lock_guard lock(mutex_);
  const std::string found = finding(queue);
  const std::string dropped = statistics_.drops(queue);
  const std::size_t points = odometry_ ? odometry_->pipeline().map().size() : 0;
  diagnostic_msgs::DiagnosticStatus status = statistics_.report(queue, points, found);
  status.name = "nvm: odometry";
  status.hardware_id = topics_.lidar;
  if (!found.empty() && finding_throttle_.passes()) {
    ROS_WARN("%s", found.c_str());
  }
  if (!dropped.empty() && drop_throttle_.passes()) {
    ROS_WARN("%s", dropped.c_str());
  }
  outputs_.publish(status);
}

}  // namespace nvm_ros
