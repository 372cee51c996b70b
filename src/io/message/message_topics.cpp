// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/message/message_topics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace nvm::io {

namespace {

constexpr char kImuType[] = "sensor_msgs/Imu";
constexpr char kCloudType[] = "sensor_msgs/PointCloud2";
constexpr char kLivoxType[] = "livox_ros_driver/CustomMsg";
constexpr char kLivox2Type[] = "livox_ros_driver2/CustomMsg";
constexpr char kLivoxInterfacesType[] = "livox_interfaces/CustomMsg";

}  // namespace

bool is_livox(const std::string& type) {
  return type == kLivoxType || type == kLivox2Type || type == kLivoxInterfacesType;
}
bool is_cloud(const std::string& type) { return type == kCloudType || is_livox(type); }
bool is_imu(const std::string& type) { return type == kImuType; }

std::vector<std::string> topics_of(
    const std::vector<MessageTopic>& topics, bool (*accepts)(const std::string&)) {
  std::vector<std::string> names;
  for (const MessageTopic& topic : topics) {
    if (accepts(topic.type) && std::find(names.begin(), names.end(), topic.name) == names.end()) {
      names.push_back(topic.name);
    }
  }
  return names;
}

std::size_t count_of(
    const std::vector<MessageTopic>& topics,
    const std::string& name,
    bool (*accepts)(const std::string&)) {
  std::size_t count = 0;
  for (const MessageTopic& topic : topics) {
    count += topic.name == name && accepts(topic.type) ? topic.count : 0;
  }
  return count;
}

std::string choose_topic(
    const char* kind,
    const std::vector<std::string>& topics,
    const std::string& wanted,
    std::vector<std::string>& notes) {
  const std::string list = fmt::format("{}", fmt::join(topics, ", "));
  if (!wanted.empty() && std::find(topics.begin(), topics.end(), wanted) == topics.end()) {
    throw std::runtime_error(
        fmt::format("has no {} topic '{}'; there are: {}", kind, wanted, list));
  }
  if (wanted.empty() && topics.size() > 1) {
    notes.push_back(fmt::format("{} topic {} is read, out of {}", kind, topics.front(), list));
  }
  return !wanted.empty() || topics.empty() ? wanted : topics.front();
}

void refuse_without_clouds(
    const std::vector<MessageTopic>& topics, const std::vector<std::string>& notes) {
  std::set<std::string> names;
  for (const MessageTopic& topic : topics) {
    names.insert(topic.name + " (" + topic.type + ")");
  }
  std::string problem = fmt::format(
      "has no topic with PointCloud2 or CustomMsg messages; there are: {}",
      names.empty() ? "no topics at all" : fmt::format("{}", fmt::join(names, ", ")));
  if (problem.find("acket") != std::string::npos) {
    problem += "; make clouds of packets with the sensor's driver, and record those";
  }
  for (const std::string& note : notes) {
    problem += "; " + note;
  }
  throw std::runtime_error(problem);
}

}  // namespace nvm::io
