// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/message/message_pipe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "io/file/doing.hpp"
#include "io/file/file.hpp"
#include "io/message/message_sequence.hpp"

namespace nvm::io {
namespace {

constexpr const char* kIsOther = "is a pipe, but not of nvm messages of version 1";
constexpr const char* kEndsEarly = "ended before its last message: whoever read it stopped";
constexpr std::uint32_t kMebibyte = 1U << 20;  // [bytes]
constexpr std::size_t kMaxHead = 1U << 20;     // [bytes]
constexpr std::uint32_t kMaxSize = 1U << 28;   // [bytes] of a message
constexpr std::size_t kMaxAhead = 1U << 29;    // [bytes] read to see the first of a topic
constexpr std::uint32_t kEnd = 0xffffffff;     // in the place of a topic: the recording is whole

class MessagePipe : public MessageSource {
 public:
  explicit MessagePipe(const std::string& path) : stream_(open_to_read(path)), source_(path) {
    try {
      read_head(nlohmann::json::parse(read_line()));
    } catch (const nlohmann::json::exception&) {
      fail(path, kIsOther);
    }
  }

  std::string recording() const override { return source_; }
  std::string format() const override { return format_; }
  std::vector<MessageTopic> topics() const override { return topics_; }

  std::vector<RecordedMessage> first(const std::string& topic, std::size_t count) override {
    std::vector<RecordedMessage> found;
    std::size_t bytes = 0;
    for (std::size_t i = 0; found.size() < std::min(count, count_of(topic)); ++i) {
      if (i == ahead_.size()) {
        auto message = bytes <= kMaxAhead ? read() : std::nullopt;
        if (!message) {
          break;
        }
        ahead_.push_back(std::move(*message));
      }
      bytes += ahead_[i].bytes.size();
      if (ahead_[i].topic == topic) {
        found.push_back(ahead_[i]);
      }
    }
    return found;
  }

  /// The writer sends the topics that are to be read, and no other.
  void select(const std::vector<std::string>& /*topics*/) override {}

  std::optional<RecordedMessage> next() override {
    if (ahead_.empty()) {
      return read();
    }
    RecordedMessage message = std::move(ahead_.front());
    ahead_.pop_front();
    return message;
  }

 private:
  /// The first line, or as much of it as a head may have.
  std::string read_line() {
    std::string line;
    for (char next = 0; line.size() < kMaxHead && stream_.get(next) && next != '\n';) {
      line += next;
    }
    return line;
  }

  void read_head(const nlohmann::json& head) {
    if (head.at("format") != "nvm messages" || head.at("version") != 1) {
      fail(source_, kIsOther);
    }
    for (const auto& topic : head.at("topics")) {
      topics_.push_back(
          {topic.at("name").get<std::string>(),
           topic.at("type").get<std::string>(),
           topic.at("count").get<std::size_t>()});
    }
    format_ = head.value("recording", "pipe");
    source_ = head.value("source", source_);
  }

  std::size_t count_of(const std::string& name) const {
    std::size_t count = 0;
    for (const MessageTopic& topic : topics_) {
      count += topic.name == name ? topic.count : 0;
    }
    return count;
  }

  template <class T>
  T get() {
    char raw[sizeof(T)];
    get(raw, sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  void get(char* to, std::size_t size) {
    if (!stream_.read(to, static_cast<std::streamsize>(size))) {
      fail(source_, kEndsEarly);
    }
  }

  void skip(std::uint32_t size) {
    stream_.ignore(size);
    if (stream_.gcount() != size) {
      fail(source_, kEndsEarly);
    }
  }

  std::optional<RecordedMessage> read() {
    if (is_over_) {
      return std::nullopt;
    }
    const auto topic = get<std::uint32_t>();
    if (topic == kEnd) {
      is_over_ = true;
      return std::nullopt;
    }
    RecordedMessage message;
    message.record_time = get<double>();
    const auto size = get<std::uint32_t>();
    if (topic >= topics_.size()) {
      fail(source_, fmt::format("sent a message of topic {} with {} bytes", topic, size));
    }
    message.topic = topics_[topic].name;
    message.type = topics_[topic].type;
    if (size > kMaxSize) {
      skip(size);
      message.problem = fmt::format(
          "has {} MiB, more than the {} that are read of one: if it is a map, name a topic of "
          "scans "
          "(input.lidar_topic)",
          size / kMebibyte + 1,
          kMaxSize / kMebibyte);
      return message;
    }
    message.bytes.resize(size);
    get(message.bytes.data(), size);
    return message;
  }

  std::ifstream stream_;
  std::string source_;  ///< the recording, for messages
  std::string format_;
  std::vector<MessageTopic> topics_;
  std::deque<RecordedMessage> ahead_;
  bool is_over_ = false;
};

}  // namespace

std::unique_ptr<SequenceReader> open_message_pipe(
    const std::string& path, const SequenceOptions& options) {
  auto pipe = std::make_unique<MessagePipe>(path);
  const std::string source = pipe->recording();
  return doing(
      "opening " + source, [&] { return read_messages(source, std::move(pipe), options); });
}

}  // namespace nvm::io
