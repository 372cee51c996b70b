// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/message/ros_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/damage.hpp"
#include "io/encoded_records.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::column;
using test::runtime_error_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

void append_text(const std::string& text, std::string& bytes) {
  append_bytes(static_cast<std::uint32_t>(text.size()), bytes);
  bytes += text;
}

std::string header(std::uint32_t seconds, std::uint32_t nanoseconds) {
  std::string bytes;
  for (const std::uint32_t number : {std::uint32_t{7}, seconds, nanoseconds}) {
    append_bytes(number, bytes);
  }
  append_text("frame", bytes);
  return bytes;
}

struct Cloud {
  std::uint32_t height = 2;
  std::uint32_t width = 3;
  std::uint32_t point_step = 16;
  std::uint32_t row_step = 50;  ///< two bytes of padding behind a row
  std::uint32_t x_offset = 0;
  std::uint32_t data_size = 100;
};

/// A cloud with float32 x y z at 0, 4, 8, a uint16 time at 12, and a field of unknown type.
std::string serialised(const Cloud& cloud) {
  std::string bytes = header(100, 500'000'000);
  append_bytes(cloud.height, bytes);
  append_bytes(cloud.width, bytes);
  append_bytes(std::uint32_t{5}, bytes);
  const auto append_field = [&](const char* name, std::uint32_t offset, std::uint8_t type) {
    append_text(name, bytes);
    append_bytes(offset, bytes);
    append_bytes(type, bytes);
    append_bytes(std::uint32_t{type == 4U ? 0U : 1U}, bytes);
  };
  append_field("z", 8, 7);
  append_field("x", cloud.x_offset, 7);
  append_field("y", 4, 7);
  append_field("t", 12, 4);
  append_field("?", 99, 77);
  append_bytes(std::uint8_t{0}, bytes);
  append_bytes(cloud.point_step, bytes);
  append_bytes(cloud.row_step, bytes);
  std::string data;
  for (std::uint32_t row = 0; row < 2; ++row) {
    for (std::uint32_t column = 0; column < 3; ++column) {
      const auto index = static_cast<float>(3 * row + column);
      for (const float value : {index, 10.0F + index, 20.0F + index}) {
        append_bytes(value, data);
      }
      append_bytes(static_cast<std::uint16_t>(100 + 3 * row + column), data);
      append_bytes(std::uint16_t{0}, data);
    }
    append_bytes(std::uint16_t{0xFFFF}, data);
  }
  append_bytes(cloud.data_size, bytes);
  bytes += data;
  bytes += '\1';
  return bytes;
}

TEST(RosMessages, PointCloud2WithPaddedRowsAndOddFields) {
  const CloudMessage message = read_point_cloud2(serialised({}));
  EXPECT_EQ(message.stamp, 100.5);
  EXPECT_THAT(column(message.records, "x"), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(column(message.records, "z"), ElementsAre(20, 21, 22, 23, 24, 25));
  EXPECT_THAT(column(message.records, "t"), ElementsAre(100, 101, 102, 103, 104, 105));
  EXPECT_EQ(message.records.find({"?"}), nullptr);
}

TEST(RosMessages, PointCloud2ThatContradictsItselfIsAnError) {
  const auto error_of = [](const Cloud& cloud) {
    return runtime_error_of([&] { read_point_cloud2(serialised(cloud)); });
  };
  Cloud cloud;
  cloud.width = 0xFFFFFFFF;
  EXPECT_THAT(error_of(cloud), HasSubstr("fewer data than its size says"));
  cloud.height = 1;
  EXPECT_THAT(error_of(cloud), HasSubstr("fewer data than its size says"));
  cloud = {};
  cloud.point_step = 0;
  EXPECT_THAT(error_of(cloud), HasSubstr("does not fit into a record of 0 bytes"));
  cloud = {};
  cloud.height = 0xFFFFFFFF;
  cloud.width = 1;
  cloud.row_step = 0;
  EXPECT_THAT(error_of(cloud), HasSubstr("fewer data than its size says"));
  cloud = {};
  cloud.x_offset = 13;
  EXPECT_THAT(error_of(cloud), HasSubstr("field 'x' does not fit"));
  cloud = {};
  cloud.data_size = 0xFFFFFFFF;
  EXPECT_THAT(error_of(cloud), HasSubstr("is truncated: a length goes beyond the end"));
  cloud = {};
  cloud.height = 0;
  EXPECT_EQ(read_point_cloud2(serialised(cloud)).records.size, 0U);
}

TEST(RosMessages, DamagedMessagesNeverDoMoreThanThrow) {
  auto rng = test::rng();
  const std::string cloud = serialised({});
  test::read_damaged(
      cloud, rng, [](const std::string& bytes) { read_point_cloud2(bytes); }, 5000);
  test::read_damaged(
      cloud, rng, [](const std::string& bytes) { read_livox_custom(bytes); }, 5000);
  test::read_damaged(
      cloud, rng, [](const std::string& bytes) { read_imu(bytes); }, 5000);
}

}  // namespace
}  // namespace nvm::io
