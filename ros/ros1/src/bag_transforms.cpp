// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "bag_transforms.hpp"

#include <ros/serialization.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <exception>

#include "io/message/ros_messages.hpp"

namespace nvm_ros {

namespace {

tf2_msgs::TFMessage transforms_of(const nvm::io::RecordedMessage& message) {
  std::string bytes = nvm::io::bytes_of(message);
  ros::serialization::IStream stream(
      reinterpret_cast<std::uint8_t*>(bytes.data()), static_cast<std::uint32_t>(bytes.size()));
  tf2_msgs::TFMessage transforms;
  ros::serialization::deserialize(stream, transforms);
  return transforms;
}

}  // namespace

void read_transforms(nvm::io::MessageSource& source, const std::string& name, tf2::BufferCore& tf) {
  constexpr std::size_t kCount = 1000;  // publishers repeat what does not change
  for (const char* const topic : {"/tf_static", "/tf"}) {
    const bool is_static = std::string(topic) == "/tf_static";
    for (const nvm::io::RecordedMessage& message : source.first(topic, kCount)) {
      try {
        for (const auto& transform : transforms_of(message).transforms) {
          tf.setTransform(transform, name, is_static);
        }
      } catch (const std::exception&) {
        continue;
      }
    }
  }
}

}  // namespace nvm_ros
