// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "node.hpp"

#include <fmt/format.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>
#include <tf2_ros/transform_listener.h>
#include <topic_tools/shape_shifter.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bag_transforms.hpp"
#include "io/message/message_topics.hpp"
#include "io/message/ros_bag_reader.hpp"
#include "io/message/ros_messages.hpp"
#include "io/sequence/sequence_options.hpp"

namespace nvm_ros {

namespace {

constexpr std::size_t kOfflineQueueSize = 20;
/// Stamps farther than this from when a message came are in another clock [s].
constexpr double kSameClock = 10.0;
/// The last messages are given this long to be sent.
const ros::WallDuration kSending(2.0);
/// Scans that may wait before they are received, where none would be counted when dropped.
constexpr std::size_t kReceiving = 10;

using Message = topic_tools::ShapeShifter;  // of any type

nvm::io::RecordedMessage recorded(const Message& message) {
  nvm::io::RecordedMessage result;
  result.type = message.getDataType();
  result.record_time = ros::Time::now().toSec();
  result.bytes.resize(message.size());
  ros::serialization::OStream stream(
      reinterpret_cast<std::uint8_t*>(result.bytes.data()),
      static_cast<std::uint32_t>(result.bytes.size()));
  message.write(stream);
  return result;
}

/// The header that a serialised message begins with.
std_msgs::Header header_of(std::string& bytes) {
  std_msgs::Header header;
  ros::serialization::IStream stream(
      reinterpret_cast<std::uint8_t*>(bytes.data()), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, header);
  return header;
}

}  // namespace

Node::Node(const NodeOptions& options) : options_(options), outputs_(handle_, options) {}

Node::~Node() { end(); }

void Node::run_online() {
  const tf2_ros::TransformListener listener(tf_);
  ROS_INFO("waiting for a LiDAR topic");
  const Topics topics = find_topics(options_, published_topics, ros::ok);
  if (topics.lidar.empty()) {
    return;  // shut down while waiting
  }
  begin(topics, options_.queue_size, SensorQueue::WhenFull::kDropOldest);
  const auto queue_size = static_cast<std::uint32_t>(options_.queue_size + kReceiving);
  const ros::Subscriber lidar = handle_.subscribe<Message>(
      topics.lidar,
      queue_size,
      [this](const Message::ConstPtr& message) { receive(recorded(*message), false); },
      ros::VoidConstPtr(),
      ros::TransportHints().tcpNoDelay());
  ros::Subscriber imu;
  if (!topics.imu.empty()) {
    imu = handle_.subscribe<Message>(
        topics.imu,
        10'000,
        [this](const Message::ConstPtr& message) { receive(recorded(*message), true); },
        ros::VoidConstPtr(),
        ros::TransportHints().tcpNoDelay());
  }
  ros::waitForShutdown();
  end();
}

void Node::run_offline() {
  if (options_.bag.empty()) {
    throw std::invalid_argument("mode = offline needs the parameter bag");
  }
  const auto source = nvm::io::ros_bag_messages({options_.bag});
  read_transforms(*source, options_.bag, tf_);
  NodeOptions options = options_;
  options.detection_time = 0.0;
  const std::vector<nvm::io::MessageTopic> recorded_topics = source->topics();
  Topics topics = find_topics(
      options, [&] { return recorded_topics; }, [] { return false; });
  if (topics.lidar.empty()) {
    nvm::io::refuse_without_clouds(recorded_topics, source->problems());
  }
  for (const std::string& problem : source->problems()) {
    topics.notes.push_back(problem);
  }
  begin(topics, kOfflineQueueSize, SensorQueue::WhenFull::kWait);
  outputs_.wait_for_listeners();
  source->select({topics.lidar, topics.imu});
  while (std::optional<nvm::io::RecordedMessage> message =
             ros::ok() ? source->next() : std::nullopt) {
    const bool is_imu = message->topic == topics.imu;
    receive(std::move(*message), is_imu);
  }
  end();
  if (odometry_) {
    tell_findings(std::numeric_limits<double>::infinity());
    outputs_.publish_all(odometry_->pipeline());
  }
  report();
  kSending.sleep();
  if (poses_ == 0) {
    throw std::runtime_error(options_.bag + ": no scan got a pose");
  }
  ROS_INFO("%s is done: %zu poses", options_.bag.c_str(), poses_);
  if (!options_.exit_when_done) {
    ros::waitForShutdown();
  }
}

void Node::begin(const Topics& topics, std::size_t queue_size, SensorQueue::WhenFull when_full) {
  topics_ = topics;
  options_.pipeline.type = nvm::lio::resolve(options_.pipeline.type, !topics.imu.empty());
  queue_ = std::make_unique<SensorQueue>(
      queue_size, when_full, !topics.imu.empty(), options_.imu_timeout);
  scans_ = nvm::io::ScanStream(nvm::io::message_time_options(options_.input));
  ROS_INFO(
      "LiDAR: %s, IMU: %s", topics.lidar.c_str(), topics.imu.empty() ? "none" : topics.imu.c_str());
  for (const std::string& note : topics.notes) {
    ROS_WARN("%s", note.c_str());
    statistics_.note(note, false);
  }
  worker_ = std::thread([this] { work(); });
  save_service_ = handle_.advertiseService("nvm/save", &Node::save, this);
  reset_service_ = handle_.advertiseService("nvm/reset", &Node::reset, this);
  report_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { report(); });
}

void Node::end() {
  if (worker_.joinable()) {
    queue_->close();
    worker_.join();
  }
}

void Node::receive(nvm::io::RecordedMessage message, bool is_imu) {
  try {
    nvm::io::bytes_of(message);  // throws where there are none
    is_imu ? take_imu(std::move(message)) : take_cloud(std::move(message));
  } catch (const std::exception& error) {  // a message that is cut off
    const std::lock_guard lock(mutex_);
    statistics_.add_bad(error.what());
  }
}

void Node::take_cloud(nvm::io::RecordedMessage message) {
  if (!nvm::io::is_cloud(message.type)) {
    refuse_type("lidar_topic", message.type);
    return;
  }
  RawCloud cloud;
  cloud.arrival = std::chrono::steady_clock::now();
  const std_msgs::Header header = header_of(message.bytes);
  cloud.frame = header.frame_id;
  cloud.stamp = header.stamp.toSec();
  if (std::abs(message.record_time - cloud.stamp) < kSameClock) {
    cloud.record_time = message.record_time;
  }
  cloud.message = std::move(message);
  queue_->add(std::move(cloud));
}

void Node::take_imu(nvm::io::RecordedMessage message) {
  if (!nvm::io::is_imu(message.type)) {
    refuse_type("imu_topic", message.type);
    return;
  }
  const nvm::ImuSample sample = nvm::io::read_imu(message.bytes);
  {
    const std::lock_guard lock(received_mutex_);
    if (!imu_frame_) {
      imu_frame_ = header_of(message.bytes).frame_id;
    }
  }
  queue_->add(sample);
}

void Node::refuse_type(const std::string& parameter, const std::string& type) {
  const std::string finding = fmt::format(
      "{} carries {}, which is not read: set {} to a topic with {}",
      parameter == "imu_topic" ? topics_.imu : topics_.lidar,
      type,
      parameter,
      parameter == "imu_topic" ? "sensor_msgs/Imu"
                               : "sensor_msgs/PointCloud2 or a Livox CustomMsg");
  const std::lock_guard lock(received_mutex_);
  type_finding_ = finding;
}

}  // namespace nvm_ros
