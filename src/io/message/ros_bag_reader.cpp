// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/message/ros_bag_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "io/message/message_sequence.hpp"
#include "io/message/ros_bags.hpp"

namespace nvm::io {
namespace {

/// The messages of ROS 1 bags by their index.
class RosBagSource : public MessageSource {
 public:
  explicit RosBagSource(const std::vector<std::string>& paths)
      : bags_(paths), file_count_(paths.size()) {}

  std::string format() const override {
    return file_count_ > 1 ? fmt::format("ROS 1 bag in {} files", file_count_) : "ROS 1 bag";
  }

  std::vector<std::string> problems() const override { return bags_.problems(); }

  std::vector<MessageTopic> topics() const override { return bags_.topics(); }

  std::vector<RecordedMessage> first(const std::string& topic, std::size_t count) override {
    std::vector<RecordedMessage> found;
    std::vector<BagMessage> messages = bags_.messages(topic);
    sort_by_time(messages);
    for (std::size_t i = 0; i < std::min(count, messages.size()); ++i) {
      found.push_back(recorded(messages[i]));
    }
    return found;
  }

  void select(const std::vector<std::string>& topics) override {
    for (const std::string& topic : topics) {
      const std::vector<BagMessage> messages = bags_.messages(topic);
      messages_.insert(messages_.end(), messages.begin(), messages.end());
    }
    sort_by_time(messages_);
  }

  std::optional<RecordedMessage> next() override {
    return next_ < messages_.size() ? std::optional(recorded(messages_[next_++])) : std::nullopt;
  }

 private:
  RecordedMessage recorded(const BagMessage& message) {
    const RosBagConnection& connection = bags_.connection(message);
    RecordedMessage result{connection.topic, connection.type, message.entry.time, {}, {}};
    try {
      result.bytes = bags_.bytes(message);
    } catch (const std::runtime_error& error) {
      result.problem = error.what();
    }
    return result;
  }

  RosBags bags_;
  std::size_t file_count_;
  std::vector<BagMessage> messages_;  ///< selected, in order of recording
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<MessageSource> ros_bag_messages(const std::vector<std::string>& paths) {
  return std::make_unique<RosBagSource>(paths);
}

std::unique_ptr<SequenceReader> open_ros_bags(
    const std::vector<std::string>& paths, const SequenceOptions& options) {
  return read_messages(paths.front(), ros_bag_messages(paths), options);
}

}  // namespace nvm::io
