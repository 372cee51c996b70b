// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "topics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/this_node.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "io/message/message_topics.hpp"

namespace nvm_ros {

using nvm::io::MessageTopic;

namespace {

/// The first topic with an accepted type; empty without one. Several make a note.
std::string choose(
    const std::vector<MessageTopic>& topics,
    bool (*accepts)(const std::string& type),
    const char* parameter,
    std::vector<std::string>& notes) {
  const std::vector<std::string> names = nvm::io::topics_of(topics, accepts);
  if (names.size() > 1) {
    notes.push_back(fmt::format(
        "{} is read, out of {}: set {} for another one",
        names.front(),
        fmt::join(names, ", "),
        parameter));
  }
  return names.empty() ? "" : names.front();
}

}  // namespace

std::vector<MessageTopic> published_topics() {
  std::vector<std::string> own;
  ros::this_node::getAdvertisedTopics(own);
  ros::master::V_TopicInfo infos;
  ros::master::getTopics(infos);
  std::vector<MessageTopic> topics;
  for (const ros::master::TopicInfo& info : infos) {
    if (std::find(own.begin(), own.end(), info.name) == own.end()) {
      topics.push_back({info.name, info.datatype, 0});
    }
  }
  std::sort(topics.begin(), topics.end(), [](const MessageTopic& a, const MessageTopic& b) {
    return a.name < b.name;
  });
  return topics;
}

Topics find_topics(
    const NodeOptions& options,
    const std::function<std::vector<MessageTopic>()>& list,
    const std::function<bool()>& goes_on) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kPeriod{200};
  const std::string& imu = options.input.imu_topic;
  const bool wants_imu =
      imu != "none" && options.pipeline.type != nvm::lio::PipelineType::kLidarOnly;
  Topics found;
  Clock::time_point deadline = Clock::time_point::max();
  while (true) {
    const std::vector<MessageTopic> topics = list();
    found = {options.input.lidar_topic, wants_imu ? imu : "", {}};
    if (found.lidar.empty()) {
      found.lidar = choose(topics, nvm::io::is_cloud, "lidar_topic", found.notes);
    }
    if (wants_imu && imu.empty()) {
      found.imu = choose(topics, nvm::io::is_imu, "imu_topic", found.notes);
    }
    const Clock::time_point now = Clock::now();
    if (!found.lidar.empty() && deadline == Clock::time_point::max()) {
      deadline = now + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(options.detection_time));
    }
    const bool is_complete = !found.lidar.empty() && (!wants_imu || !found.imu.empty());
    if (is_complete || now >= deadline || !goes_on()) {
      break;
    }
    std::this_thread::sleep_for(kPeriod);
  }
  if (wants_imu && found.imu.empty() && !found.lidar.empty()) {
    found.notes.push_back(fmt::format(
        "no IMU topic within {} s: odometry from scans alone; set imu_topic to wait for one",
        options.detection_time));
  }
  return found;
}

}  // namespace nvm_ros
