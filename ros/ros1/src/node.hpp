// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <std_srvs/Trigger.h>
#include <tf2/buffer_core.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "finding_watch.hpp"
#include "frames.hpp"
#include "io/message/message_source.hpp"
#include "io/scan/scan_stream.hpp"
#include "node_options.hpp"
#include "odometry.hpp"
#include "outputs.hpp"
#include "sensor_queue.hpp"
#include "statistics.hpp"
#include "throttle.hpp"
#include "topics.hpp"

namespace nvm_ros {

/// The odometry node: one thread receives messages, another works on them.
class Node {
 public:
  explicit Node(const NodeOptions& options);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Runs on topics until ROS shuts down.
  void run_online();

  /// Runs on the bag. Throws std::runtime_error when it cannot be read or no scan gets a pose.
  void run_offline();

 private:
  void begin(const Topics& topics, std::size_t queue_size, SensorQueue::WhenFull when_full);
  void end();
  void receive(nvm::io::RecordedMessage message, bool is_imu);
  void take_cloud(nvm::io::RecordedMessage message);
  void take_imu(nvm::io::RecordedMessage message);
  void refuse_type(const std::string& parameter, const std::string& type);

  void work();
  void learn();
  void try_to_process(const RawCloud& cloud);
  void process(const RawCloud& cloud);
  double imu_needed_until(double time);
  void find_frames_once(const std::string& lidar_frame, std::unique_lock<std::mutex>& lock);
  void begin_anew(const std::string& reason);
  void tell(const nvm::lio::FrameResult& frame, const RawCloud& cloud);
  void tell_findings(double time);
  void look_at_clocks(const nvm::Scan& scan, bool has_readings);

  void report();
  std::string finding(const QueueStats& queue);
  bool save(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  std::string save_to(const std::string& folder);
  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  NodeOptions options_;
  ros::NodeHandle handle_;
  tf2::BufferCore tf_;
  Topics topics_;
  std::unique_ptr<SensorQueue> queue_;
  std::thread worker_;
  // Of the worker:
  nvm::io::ScanStream scans_;
  std::vector<RawCloud> first_;  ///< clouds that wait until there are enough to learn from
  bool has_learnt_ = false;
  std::size_t epoch_ = 0;
  Throttle bad_scan_throttle_;
  // Of whoever holds the mutex; the receiving thread must not wait for the worker:
  std::mutex received_mutex_;
  std::optional<std::string> imu_frame_;
  std::string type_finding_;  // a topic with the wrong type
  // Of whoever holds the mutex:
  std::mutex mutex_;
  std::string clock_finding_;  // clocks that do not fit
  std::optional<Frames> frames_;
  std::unique_ptr<Odometry> odometry_;
  Outputs outputs_;
  Statistics statistics_;
  FindingWatch finding_watch_;
  std::optional<nvm::lio::FrameStatus> told_;
  std::size_t poses_ = 0;
  std::size_t reported_clouds_ = 0;
  int silent_reports_ = 0;
  Throttle finding_throttle_;
  Throttle drop_throttle_;

  ros::ServiceServer save_service_, reset_service_;
  ros::WallTimer report_timer_;
};

}  // namespace nvm_ros
