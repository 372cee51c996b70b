// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>
#include <ros/console.h>

#include <cmath>
#include <exception>
#include <utility>

#include "io/message/ros_messages.hpp"
#include "node.hpp"

namespace nvm_ros {

namespace {

/// Its points, when it was published, and the topic. Throws std::runtime_error.
nvm::io::CloudMessage read(const RawCloud& raw, const std::string& topic) {
  nvm::io::CloudMessage cloud = nvm::io::read_cloud(raw.message);
  cloud.record_time = raw.record_time;
  cloud.records.source = topic;
  return cloud;
}

}  // namespace

void Node::work() {
  constexpr std::size_t kEnough = 10;
  while (std::optional<RawCloud> cloud = queue_->next_cloud()) {
    if (has_learnt_) {
      try_to_process(*cloud);
      continue;
    }
    first_.push_back(std::move(*cloud));
    if (first_.size() >= kEnough) {
      learn();
    }
  }
  learn();
}

// How points and scans are dated is judged over the first clouds, as any one may be bad.
void Node::learn() {
  std::vector<nvm::io::CloudMessage> clouds;
  for (const RawCloud& raw : first_) {
    try {
      clouds.push_back(read(raw, topics_.lidar));
    } catch (const std::exception&) {
      continue;  // try_to_process() tells it
    }
  }
  clouds = nvm::io::ScanStream::select(std::move(clouds));
  if (!clouds.empty()) {
    scans_.learn(clouds);
    has_learnt_ = true;
  }
  for (const RawCloud& raw : first_) {
    try_to_process(raw);
  }
  first_.clear();
}

void Node::try_to_process(const RawCloud& cloud) {
  try {
    process(cloud);
  } catch (const std::exception& error) {
    if (bad_scan_throttle_.passes()) {
      ROS_ERROR("a scan is left out: %s", error.what());
    }
    const std::lock_guard lock(mutex_);
    statistics_.add_bad(error.what());
  }
}

void Node::process(const RawCloud& cloud) {
  if (cloud.epoch != epoch_) {
    epoch_ = cloud.epoch;
    const std::lock_guard lock(mutex_);
    begin_anew(fmt::format("time has gone back to {:.3f} s", cloud.stamp));
  }
  const nvm::io::CloudMessage message = read(cloud, topics_.lidar);
  scans_.check(message);
  const nvm::Scan scan = scans_.convert(message.records, cloud.stamp);
  const auto readings = queue_->imu_until(cloud, imu_needed_until(scan.t_end));
  if (!readings) {
    return;
  }
  std::unique_lock lock(mutex_);
  find_frames_once(cloud.frame, lock);
  if (!odometry_) {
    nvm::lio::FrameResult waiting;
    waiting.time = scan.t_end;
    waiting.message = "no message on " + topics_.imu + " yet";
    tell(waiting, cloud);
    return;
  }
  look_at_clocks(scan, !readings->empty());
  const nvm::lio::FrameResult frame = odometry_->process(*readings, scan);
  outputs_.publish(frame, odometry_->pipeline(), *frames_);
  tell(frame, cloud);
  tell_findings(frame.time);
}

double Node::imu_needed_until(double time) {
  const std::lock_guard lock(mutex_);
  return odometry_ ? odometry_->pipeline().imu_needed_until(time)
                   : time - options_.pipeline.inertial.imu_input.time_offset;
}

// Leaves the mutex to others while it waits for TF.
void Node::find_frames_once(const std::string& lidar_frame, std::unique_lock<std::mutex>& lock) {
  if (odometry_) {
    return;
  }
  std::optional<std::string> imu_frame;
  if (!topics_.imu.empty()) {
    const std::lock_guard received_lock(received_mutex_);
    imu_frame = imu_frame_;
    if (!imu_frame) {
      return;
    }
  }
  lock.unlock();
  Frames frames = find_frames(tf_, lidar_frame, imu_frame, options_);
  lock.lock();
  statistics_.clear_warnings();
  for (const std::string& note : frames.notes) {
    ROS_WARN("%s", note.c_str());
    statistics_.note(note, true);
  }
  nvm::lio::PipelineOptions pipeline = options_.pipeline;
  pipeline.inertial.T_imu_lidar = frames.T_body_lidar;
  odometry_ = std::make_unique<Odometry>(pipeline, options_.input.accel_unit);
  frames_ = std::move(frames);
}

void Node::begin_anew(const std::string& reason) {
  ROS_WARN("%s: odometry and map begin anew", reason.c_str());
  odometry_.reset();
  outputs_.reset();
  told_.reset();
  finding_watch_ = {};
  statistics_.count_reset();
}

void Node::tell(const nvm::lio::FrameResult& frame, const RawCloud& cloud) {
  statistics_.add(frame, cloud.arrival);
  poses_ += has_pose(frame) ? 1 : 0;
  if (told_ == frame.status) {
    return;
  }
  told_ = frame.status;
  const char* const status = nvm::lio::name(frame.status);
  if (frame.status == nvm::lio::FrameStatus::kTracking) {
    ROS_INFO("%s: pose of %s in %s", status, frames_->base.c_str(), options_.odom_frame.c_str());
  } else {
    ROS_WARN("%s at %.3f s: %s", status, frame.time, frame.message.c_str());
  }
}

void Node::tell_findings(double time) {
  std::vector<std::string> findings = odometry_->pipeline().findings();
  const std::vector<std::string> of_scans = scans_.findings();
  findings.insert(findings.end(), of_scans.begin(), of_scans.end());
  for (const std::string& finding : finding_watch_.new_ones(time, findings)) {
    ROS_WARN("%s", finding.c_str());
    statistics_.note(finding, true);
  }
}

void Node::look_at_clocks(const nvm::Scan& scan, bool has_readings) {
  constexpr double kFar = 1.0;  // [s]
  const double newest = queue_->stats().newest_imu;
  const double ahead = newest - scan.t_end;
  clock_finding_.clear();
  if (!has_readings && std::isfinite(newest) && std::abs(ahead) > kFar) {
    clock_finding_ = fmt::format(
        "stamps of {} are {:.3f} s {} those of {}: the sensors' clocks must agree (PTP, or a "
        "driver "
        "that stamps with the host's time)",
        topics_.imu,
        std::abs(ahead),
        ahead > 0.0 ? "ahead of" : "behind",
        topics_.lidar);
  }
}

}  // namespace nvm_ros
