// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nvm::io {

/// A message of a recording.
struct RecordedMessage {
  std::string topic;
  std::string type;          ///< "sensor_msgs/Imu"
  double record_time = 0.0;  ///< [s]
  std::string bytes;         ///< as ROS 1 serialises it
  std::string problem;       ///< why there are no bytes; empty when there are
};

/// A topic of a recording.
struct MessageTopic {
  std::string name;
  std::string type;
  std::size_t count = 0;  ///< of its messages
};

/// Where the messages of a recording come from.
class MessageSource {
 public:
  virtual ~MessageSource() = default;

  /// "ROS 1 bag", ...
  virtual std::string format() const = 0;

  /// The recording that another program reads; empty when it is read here.
  virtual std::string recording() const { return ""; }

  /// What is wrong with the recording as a whole, for the user.
  virtual std::vector<std::string> problems() const { return {}; }

  /// In order of appearance; a topic with messages of several types is there several times.
  virtual std::vector<MessageTopic> topics() const = 0;

  /// The first `count` messages of a topic, or as many as there are. Called before select().
  virtual std::vector<RecordedMessage> first(const std::string& topic, std::size_t count) = 0;

  /// Lets next() begin with the first message of these topics.
  virtual void select(const std::vector<std::string>& topics) = 0;

  /// The next message in order of recording; nothing at the end. Throws std::runtime_error when
  /// the recording is damaged.
  virtual std::optional<RecordedMessage> next() = 0;
};

}  // namespace nvm::io
