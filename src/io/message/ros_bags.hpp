// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/message/message_source.hpp"
#include "io/message/ros_bag_file.hpp"

namespace nvm::io {

/// A message of one of a recording's bags.
struct BagMessage {
  std::size_t bag = 0;
  RosBagEntry entry;
};

/// The bags of a recording that was split, or the only one, read as one.
class RosBags {
 public:
  /// Throws std::runtime_error, naming the file, for one that is no bag.
  explicit RosBags(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
      bags_.emplace_back(path);
    }
  }

  /// The topic and type of a message.
  const RosBagConnection& connection(const BagMessage& message) const {
    return bags_[message.bag].connections().at(message.entry.connection);
  }

  /// RosBagFile::message.
  std::string_view bytes(const BagMessage& message) {
    return bags_[message.bag].message(message.entry);
  }

  /// In order of appearance; one for each type of a topic.
  std::vector<MessageTopic> topics() const {
    std::vector<MessageTopic> topics;
    for (const RosBagFile& bag : bags_) {
      std::map<std::uint32_t, std::size_t> counts;
      for (const RosBagEntry& entry : bag.entries()) {
        ++counts[entry.connection];
      }
      for (const auto& [id, connection] : bag.connections()) {
        const auto is_same = [&c = connection](const MessageTopic& topic) {
          return topic.name == c.topic && topic.type == c.type;
        };
        const auto known = std::find_if(topics.begin(), topics.end(), is_same);
        if (known != topics.end()) {
          known->count += counts[id];
        } else {
          topics.push_back({connection.topic, connection.type, counts[id]});
        }
      }
    }
    return topics;
  }

  /// The messages of a topic, by file.
  std::vector<BagMessage> messages(const std::string& topic) const {
    std::vector<BagMessage> messages;
    for (std::size_t i = 0; i < bags_.size(); ++i) {
      const auto& connections = bags_[i].connections();
      for (const RosBagEntry& entry : bags_[i].entries()) {
        const auto connection = connections.find(entry.connection);
        if (connection != connections.end() && connection->second.topic == topic) {
          messages.push_back({i, entry});
        }
      }
    }
    return messages;
  }

  /// What is wrong with whole files, for the user.
  std::vector<std::string> problems() const {
    std::vector<std::string> problems;
    for (const RosBagFile& bag : bags_) {
      if (!bag.problem().empty()) {
        problems.push_back(bag.path() + ": " + bag.problem());
      }
    }
    return problems;
  }

 private:
  std::deque<RosBagFile> bags_;
};

/// Into the order of recording.
inline void sort_by_time(std::vector<BagMessage>& messages) {
  std::stable_sort(messages.begin(), messages.end(), [](const BagMessage& a, const BagMessage& b) {
    return a.entry.time < b.entry.time;
  });
}

}  // namespace nvm::io
