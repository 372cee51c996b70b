// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "io/cloud/point_records.hpp"
#include "io/damage.hpp"
#include "io/message/ros_bag_writer.hpp"
#include "io/message/ros_bags.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::HasSubstr;
using ::testing::StartsWith;

#ifndef NVM_WITH_ROSBAG

TEST(MessagePipe, IsNotCompared) { GTEST_SKIP() << "built without ROS 1 bags"; }

#else

struct Data {
  std::string format;
  std::vector<Scan> scans;
  std::vector<ImuSample> imu;
};

Data read_all(const std::string& path) {
  const auto reader = open_sequence(path);
  Data data;
  while (auto scan = reader->next_scan()) {
    data.scans.push_back(std::move(*scan));
    for (const ImuSample& sample : reader->imu_until(data.scans.back().t_end)) {
      data.imu.push_back(sample);
    }
  }
  data.format = reader->info().format;
  return data;
}

class MessagePipe : public test::TemporaryFolder {
 protected:
  /// Calls `action` with a pipe into which `bytes` are written meanwhile, by a sender that then
  /// ends.
  template <class Action>
  auto with_pipe(const std::string& bytes, const Action& action) const {
    const std::string pipe = path("pipe");
    std::filesystem::remove(pipe);
    EXPECT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::signal(SIGPIPE, SIG_IGN);  // a reader that has read enough is no end of the test
    std::thread sender([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
    struct Joined {
      std::thread& thread;
      ~Joined() { thread.join(); }
    } joined{sender};
    return action(pipe);
  }

  std::string failure(const std::string& bytes) const {
    return with_pipe(
        bytes, [](const std::string& pipe) { return runtime_error_of([&] { read_all(pipe); }); });
  }

  std::string write_bag(CloudMessageType type) const {
    RosBagWriter bag(path("walk.bag"), type);
    for (int i = 0; i < 10; ++i) {
      Scan scan{1000.0 + 0.1 * i, 1000.1 + 0.1 * i, {}};
      for (int k = 0; k < 300; ++k) {
        const auto value = static_cast<float>(std::sin(k + i));
        const auto ring = static_cast<std::uint16_t>(k % 4);
        scan.points.push_back({value, 2.0F, 1e3F, 20.0F, 3e-4F * static_cast<float>(k), ring});
      }
      bag.add_scan(scan);
    }
    for (double time = 1000.0; time < 1001.0; time += 0.005) {
      bag.add_imu({time, {0.1, std::sin(time), -0.3}, {0.0, 0.1, 9.81}});
    }
    bag.commit();
    return path("walk.bag");
  }

  /// The messages of a bag as docs/formats.md has them, without the mark of the end.
  static std::string messages_of(const std::string& bag) {
    RosBags bags({bag});
    const std::vector<MessageTopic> topics = bags.topics();
    std::string head;
    std::vector<BagMessage> messages;
    for (const MessageTopic& topic : topics) {
      head += fmt::format(
          R"({}{{"name": "{}", "type": "{}", "count": {}}})",
          head.empty() ? "" : ", ",
          topic.name,
          topic.type,
          topic.count);
      const auto its = bags.messages(topic.name);
      messages.insert(messages.end(), its.begin(), its.end());
    }
    sort_by_time(messages);
    std::string bytes = R"({"format": "nvm messages", "version": 1, "source": "walk.mcap", )"
                        R"("recording": "ROS 2 bag", "topics": [)" +
                        head + "]}\n";
    for (const BagMessage& message : messages) {
      const bool is_first = bags.connection(message).topic == topics[0].name;
      append_bytes<std::uint32_t>(is_first ? 0 : 1, bytes);
      append_bytes(message.entry.time, bytes);
      const std::string_view content = bags.bytes(message);
      append_bytes(static_cast<std::uint32_t>(content.size()), bytes);
      bytes += content;
    }
    return bytes;
  }

  static std::string whole(std::string bytes) {
    append_bytes<std::uint32_t>(0xffffffff, bytes);
    return bytes;
  }
};

TEST_F(MessagePipe, GivesTheBitsOfTheBag) {
  for (const auto type : {CloudMessageType::kPointCloud2, CloudMessageType::kLivox2Custom}) {
    const std::string bag = write_bag(type);
    const Data expected = read_all(bag);
    const Data data = with_pipe(whole(messages_of(bag)), read_all);
    EXPECT_EQ(data.format, "ROS 2 bag");
    ASSERT_EQ(expected.scans.size(), 10U);
    ASSERT_EQ(data.scans.size(), expected.scans.size());
    for (std::size_t i = 0; i < data.scans.size(); ++i) {
      EXPECT_EQ(data.scans[i].t_begin, expected.scans[i].t_begin);
      EXPECT_EQ(data.scans[i].t_end, expected.scans[i].t_end);
      ASSERT_EQ(data.scans[i].points.size(), 300U);
      for (std::size_t k = 0; k < 300; ++k) {
        const TimedPoint& point = data.scans[i].points[k];
        const TimedPoint& other = expected.scans[i].points[k];
        EXPECT_EQ(
            std::tie(point.x, point.y, point.z, point.intensity, point.dt, point.ring),
            std::tie(other.x, other.y, other.z, other.intensity, other.dt, other.ring));
      }
    }
    ASSERT_GT(expected.imu.size(), 190U);
    ASSERT_EQ(data.imu.size(), expected.imu.size());
    for (std::size_t i = 0; i < data.imu.size(); ++i) {
      EXPECT_EQ(data.imu[i].time, expected.imu[i].time);
      EXPECT_EQ(data.imu[i].gyro, expected.imu[i].gyro);
      EXPECT_EQ(data.imu[i].accel, expected.imu[i].accel);
    }
  }
}

TEST_F(MessagePipe, ThatEndsWithoutItsMarkIsNamedWhereverItEnds) {
  const std::string bytes = whole(messages_of(write_bag(CloudMessageType::kLivoxCustom)));
  const std::size_t head = bytes.find('\n') + 1;
  for (std::size_t size = head; size < bytes.size(); size += 1 + bytes.size() / 40) {
    EXPECT_THAT(
        failure(bytes.substr(0, size)), StartsWith("walk.mcap: ended before its last message"))
        << size;
  }
  EXPECT_THAT(failure(bytes.substr(0, bytes.size() - 1)), StartsWith("walk.mcap: ended before"));
  for (const std::size_t size : {std::size_t{0}, head / 2}) {
    EXPECT_THAT(
        failure(bytes.substr(0, size)), HasSubstr("pipe: is a pipe, but not of nvm messages"));
  }
}

TEST_F(MessagePipe, ScansBeforeTheSenderDiesAreRead) {
  const std::string bytes = messages_of(write_bag(CloudMessageType::kPointCloud2));
  std::size_t scans = 0;
  const std::string error = with_pipe(bytes, [&](const std::string& pipe) {
    const auto reader = open_sequence(pipe);
    return runtime_error_of([&] {
      for (; reader->next_scan(); ++scans) {
      }
    });
  });
  EXPECT_THAT(error, HasSubstr("ended before its last message"));
  EXPECT_GE(scans, 8U);
}

TEST_F(MessagePipe, WithAnotherHeadIsRefusedInOneLine) {
  for (const char* head :
       {"",
        "\n",
        "{}\n",
        "[1, 2]\n",
        R"({"format": "nvm messages", "version": 2, "topics": []})"
        "\n",
        R"({"format": 7, "version": "1"})"
        "\n",
        R"({"format": "nvm messages", "version": 1})"
        "\n",
        R"({"format": "nvm messages", "version": 1, "source": 3, "topics": []})"
        "\n",
        R"({"format": "nvm messages", "version": 1, "topics": {"name": "/points"}})"
        "\n",
        R"({"format": "nvm messages", "version": 1, "topics": [{"name": "/points", "count": 1}]})"
        "\n"}) {
    EXPECT_THAT(failure(head), HasSubstr("pipe: is a pipe, but not of nvm messages of version 1"))
        << head;
  }
  EXPECT_THAT(
      failure(std::string(1U << 23U, 'x')), HasSubstr("is a pipe, but not of nvm messages"));
}

TEST_F(MessagePipe, ImpossibleRecordsAreRefused) {
  const std::string bytes = messages_of(write_bag(CloudMessageType::kPointCloud2));
  std::string record = bytes.substr(0, bytes.find('\n') + 1);
  append_bytes<std::uint32_t>(2, record);
  append_bytes(1000.0, record);
  append_bytes<std::uint32_t>(4, record);
  EXPECT_THAT(failure(record + "abcd"), StartsWith("walk.mcap: sent a message of topic 2 with 4"));
  record = bytes.substr(0, bytes.find('\n') + 1);
  append_bytes<std::uint32_t>(0, record);
  append_bytes(1000.0, record);
  append_bytes<std::uint32_t>(0xfffffff0, record);
  EXPECT_THAT(failure(record), StartsWith("walk.mcap: ended before its last message"));
}

TEST_F(MessagePipe, AMessageThatIsTooLargeIsLeftOutAndTheRestRead) {
  const std::string bytes = messages_of(write_bag(CloudMessageType::kPointCloud2));
  constexpr std::uint32_t kTooLarge = (1U << 28U) + 1;
  std::string record;
  append_bytes<std::uint32_t>(0, record);
  append_bytes(1000.05, record);
  append_bytes(kTooLarge, record);
  record.append(kTooLarge, 'x');
  for (const bool is_first : {true, false}) {
    std::string sent = bytes;
    sent.insert(is_first ? bytes.find('\n') + 1 : bytes.size(), record);
    with_pipe(whole(std::move(sent)), [](const std::string& pipe) {
      const auto reader = open_sequence(pipe);
      std::size_t scans = 0;
      while (reader->next_scan()) {
        ++scans;
      }
      EXPECT_EQ(scans, 10U);
      EXPECT_EQ(reader->info().skipped_scans, 1U);
      EXPECT_THAT(
          reader->info().notes,
          ::testing::Contains(
              ::testing::ContainsRegex("1 clouds are left out; the first: .* at 1000.050000 s has "
                                       "257 MiB, more than the 256 "
                                       "that are read of one: .*input.lidar_topic")));
    });
  }
}

TEST_F(MessagePipe, GarbageIsAnErrorOrLeftOut) {
  auto random = test::rng();
  test::read_damaged(
      whole(messages_of(write_bag(CloudMessageType::kLivoxCustom))),
      random,
      [&](const std::string& bytes) { with_pipe(bytes, read_all); },
      100);
}

#endif

}  // namespace
}  // namespace nvm::io
