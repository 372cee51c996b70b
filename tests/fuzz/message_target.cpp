// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Messages of any bytes, on a topic of clouds and one of an IMU, are left out or give scans and IMU
// samples in order of time.
#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "fuzz_target.hpp"
#include "io/message/message_sequence.hpp"
#include "sequence_check.hpp"

namespace {

using nvm::fuzz::Input;
using nvm::io::MessageTopic;
using nvm::io::RecordedMessage;

const std::array<std::string, 3> kTypes{
    "sensor_msgs/PointCloud2", "livox_ros_driver/CustomMsg", "sensor_msgs/Imu"};

class MemorySource : public nvm::io::MessageSource {
 public:
  explicit MemorySource(std::vector<RecordedMessage> messages) : messages_(std::move(messages)) {
    for (const RecordedMessage& message : messages_) {
      const auto is_its = [&](const MessageTopic& topic) { return topic.name == message.topic; };
      const auto known = std::find_if(topics_.begin(), topics_.end(), is_its);
      if (known == topics_.end()) {
        topics_.push_back({message.topic, message.type, 1});
      } else {
        ++known->count;
      }
    }
  }

  std::string format() const override { return "fuzz"; }
  std::vector<MessageTopic> topics() const override { return topics_; }
  std::vector<RecordedMessage> first(const std::string& topic, std::size_t count) override {
    std::vector<RecordedMessage> found;
    for (const RecordedMessage& message : messages_) {
      if (message.topic == topic && found.size() < count) {
        found.push_back(message);
      }
    }
    return found;
  }
  void select(const std::vector<std::string>& topics) override { selected_ = topics; }
  std::optional<RecordedMessage> next() override {
    while (next_ < messages_.size()) {
      const RecordedMessage& message = messages_[next_++];
      if (std::count(selected_.begin(), selected_.end(), message.topic) > 0) {
        return message;
      }
    }
    return std::nullopt;
  }

 private:
  std::vector<RecordedMessage> messages_;
  std::vector<MessageTopic> topics_;
  std::vector<std::string> selected_;
  std::size_t next_ = 0;
};

/// Two bytes of length and a byte that says which kind, when, and how often, before each message.
std::vector<RecordedMessage> take_messages(Input& input) {
  std::vector<RecordedMessage> messages;
  double time = 1000.0;
  while (!input.empty() && messages.size() < 200) {
    const auto& type = kTypes[static_cast<std::size_t>(input.below(3))];
    const auto steps = input.take<std::uint8_t>();
    const std::string bytes = input.take_text(input.take<std::uint16_t>());
    for (int repeat = 0; repeat <= steps / 32; ++repeat) {
      time += 0.01 * (steps % 32);
      messages.push_back({"/" + type, type, time, bytes, ""});
    }
  }
  return messages;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  nvm::fuzz::accepts([&] {
    const auto reader = nvm::io::read_messages(
        "fuzz", std::make_unique<MemorySource>(take_messages(input)), nvm::io::SequenceOptions{});
    nvm::fuzz::read_all(*reader);
  });
  return 0;
}
