// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "frames.hpp"

#include <fmt/format.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>

#include <Eigen/Geometry>
#include <chrono>
#include <optional>
#include <thread>

#include "io/sequence/sequence_options.hpp"

namespace nvm_ros {

namespace {

using nvm::Pose;

/// tf2 refuses names that begin with a slash, which ROS had until 2012 and drivers still send.
std::string tf_name(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

/// T_target_source, as far as TF knows it now.
std::optional<Pose> look_up(
    const tf2::BufferCore& tf, const std::string& target, const std::string& source) {
  if (target == source) {
    return Pose::Identity();
  }
  try {
    const auto transform = tf.lookupTransform(target, source, ros::Time(0)).transform;
    const auto& q = transform.rotation;
    Pose pose = Pose::Identity();
    pose.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
    pose.translation() << transform.translation.x, transform.translation.y, transform.translation.z;
    return pose;
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

/// The frame that `frame` hangs in, if any, up to `odom`; the name of what is below it else.
std::string root_of(const tf2::BufferCore& tf, std::string frame, const std::string& odom) {
  constexpr int kMaxDepth = 100;  // a ring of frames has no root
  std::string parent;
  for (int i = 0; i < kMaxDepth && tf._getParent(frame, ros::Time(0), parent); ++i) {
    if (parent == odom) {
      break;
    }
    frame = parent;
  }
  return frame;
}

/// What is known of the frames at one moment; is_complete when waiting cannot tell more.
struct Findings {
  std::optional<Pose> T_body_lidar;
  std::optional<Pose> T_body_base;
  std::string base;
  bool is_complete() const { return T_body_lidar && T_body_base; }
};

Findings find_now(
    const tf2::BufferCore& tf,
    const std::string& lidar,
    const std::string& body,
    const NodeOptions& options) {
  Findings found;
  found.T_body_lidar = look_up(tf, body, lidar);
  found.base = tf_name(options.base_frame);
  std::string parent;
  if (!found.base.empty() || tf._getParent(body, ros::Time(0), parent)) {
    found.base = found.base.empty() ? root_of(tf, body, options.odom_frame) : found.base;
    found.T_body_base = look_up(tf, body, found.base);
  }
  return found;
}

std::string as_text(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const auto& t = pose.translation();
  return fmt::format(
      "[{:.4f}, {:.4f}, {:.4f}, {:.5f}, {:.5f}, {:.5f}, {:.5f}]",
      t.x(),
      t.y(),
      t.z(),
      q.x(),
      q.y(),
      q.z(),
      q.w());
}

bool differ(const Pose& a, const Pose& b) {
  constexpr double kFar = 0.002;     // [m]
  constexpr double kTurned = 0.005;  // [rad]
  const Pose difference = a.inverse() * b;
  return difference.translation().norm() > kFar ||
         nvm::so3_log(difference.linear()).norm() > kTurned;
}

/// The extrinsic: the option's, else TF's, else the identity.
void choose_extrinsic(
    const Findings& found,
    const std::string& lidar,
    const std::string& imu,
    const NodeOptions& options,
    Frames& frames) {
  frames.T_body_lidar = found.T_body_lidar.value_or(Pose::Identity());
  if (!options.input.T_imu_lidar.empty()) {
    frames.T_body_lidar = nvm::io::extrinsic(options.input, Pose::Identity());
    if (found.T_body_lidar && imu != lidar && differ(frames.T_body_lidar, *found.T_body_lidar)) {
      frames.notes.push_back(fmt::format(
          "parameter T_imu_lidar is used, but TF says {} from {} to {}: remove the parameter if TF "
          "is right",
          as_text(*found.T_body_lidar),
          imu,
          lidar));
    }
  } else if (!found.T_body_lidar) {
    frames.notes.push_back(fmt::format(
        "TF has no transform between '{}' (IMU) and '{}' (LiDAR): they are taken to be in one "
        "place and not turned; publish it on /tf_static or set T_imu_lidar",
        imu,
        lidar));
  }
}

void choose_base(
    const Findings& found, const std::string& body, const NodeOptions& options, Frames& frames) {
  frames.base = found.base.empty() ? body : found.base;
  frames.base = frames.base.empty() ? "base_link" : frames.base;  // drivers that name none
  frames.T_body_base = found.T_body_base.value_or(Pose::Identity());
  if (!found.base.empty() && !found.T_body_base) {
    frames.notes.push_back(fmt::format(
        "TF has no transform between '{}' (base_frame) and '{}': they are taken to be in one place "
        "and not turned; publish it on /tf_static or leave base_frame empty",
        frames.base,
        body));
  }
  if (frames.base == options.odom_frame) {
    throw std::invalid_argument(fmt::format(
        "odom_frame = base_frame = '{}': set one of them to another name", frames.base));
  }
}

}  // namespace

Frames find_frames(
    const tf2::BufferCore& tf,
    const std::string& lidar,
    const std::optional<std::string>& imu,
    const NodeOptions& options) {
  const std::string lidar_frame = tf_name(lidar);
  const std::string body = imu ? tf_name(*imu) : lidar_frame;
  const auto deadline =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(options.tf_timeout);
  Findings found = find_now(tf, lidar_frame, body, options);
  while (!found.is_complete() && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    found = find_now(tf, lidar_frame, body, options);
  }
  Frames frames;
  if (imu) {
    choose_extrinsic(found, lidar_frame, body, options, frames);
  } else if (!options.input.T_imu_lidar.empty()) {
    frames.notes.push_back("without an IMU the parameter T_imu_lidar is not used");
  }
  choose_base(found, body, options, frames);
  return frames;
}

}  // namespace nvm_ros
