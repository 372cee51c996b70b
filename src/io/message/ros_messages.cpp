// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/message/ros_messages.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "io/file/byte_cursor.hpp"
#include "io/message/message_topics.hpp"

namespace nvm::io {
namespace {

/// The stamp [s] of a std_msgs/Header, and its frame_id.
std::pair<double, std::string_view> header(ByteCursor& cursor) {
  cursor.next<std::uint32_t>();  // seq
  const auto seconds = cursor.next<std::uint32_t>();
  const auto nanoseconds = cursor.next<std::uint32_t>();
  return {seconds + 1e-9 * nanoseconds, cursor.sized_block()};
}

Eigen::Vector3d vector(ByteCursor& cursor) {
  const auto x = cursor.next<double>();
  const auto y = cursor.next<double>();
  return {x, y, cursor.next<double>()};
}

/// The type that PointField's datatypes 1 to 8 stand for.
std::optional<ScalarType> scalar_type(std::uint8_t datatype) {
  constexpr std::array<ScalarType, 8> kTypes = {
      ScalarType::kInt8,
      ScalarType::kUint8,
      ScalarType::kInt16,
      ScalarType::kUint16,
      ScalarType::kInt32,
      ScalarType::kUint32,
      ScalarType::kFloat32,
      ScalarType::kFloat64};
  return datatype >= 1 && datatype <= kTypes.size() ? std::optional(kTypes[datatype - 1U])
                                                    : std::nullopt;
}

std::vector<Field> point_fields(ByteCursor& cursor) {
  std::vector<Field> fields;
  for (auto left = cursor.next<std::uint32_t>(); left > 0; --left) {
    Field field;
    field.name = cursor.sized_block();
    field.offset = cursor.next<std::uint32_t>();
    const auto type = scalar_type(cursor.next<std::uint8_t>());
    field.count = std::max<std::size_t>(cursor.next<std::uint32_t>(), 1);  // some drivers write 0
    if (type) {
      field.type = *type;
      fields.push_back(std::move(field));
    }
  }
  return fields;
}

/// The points of `data` without the padding between rows. A row_step below the row's size, as some
/// drivers write, counts as none.
std::string packed_rows(
    std::string_view data, std::size_t height, std::size_t row_size, std::size_t row_step) {
  const std::size_t step = std::max(row_step, row_size);
  if (height > data.size() / std::max<std::size_t>(row_size, 1) ||
      (height - 1) * step + row_size > data.size()) {
    throw std::runtime_error("the cloud has fewer data than its size says");
  }
  std::string bytes;
  for (std::size_t row = 0; row < height; ++row) {
    bytes += data.substr(row * step, row_size);
  }
  return bytes;
}

}  // namespace

CloudMessage read_point_cloud2(std::string_view bytes) {
  ByteCursor cursor(bytes);
  CloudMessage message;
  PointRecords& records = message.records;
  std::tie(message.stamp, message.frame) = header(cursor);
  const std::size_t height = cursor.next<std::uint32_t>();
  const std::size_t width = cursor.next<std::uint32_t>();
  records.source = "PointCloud2";
  records.fields = point_fields(cursor);
  records.is_big_endian = cursor.next<std::uint8_t>() != 0;
  records.record_size = cursor.next<std::uint32_t>();
  const std::size_t row_step = cursor.next<std::uint32_t>();
  const std::string_view data = cursor.sized_block();
  const std::size_t row_size = width * records.record_size;
  records.size = width * height;
  if (records.size > 0) {
    const bool is_packed = height == 1 || row_step == row_size;
    records.bytes = is_packed ? std::string(data) : packed_rows(data, height, row_size, row_step);
  }
  records = checked(std::move(records));
  if (records.missing > 0) {
    throw std::runtime_error("the cloud has fewer data than its size says");
  }
  return message;
}

PointRecords livox_records() {
  PointRecords records;
  records.source = "CustomMsg";
  records.add_field("offset_time", ScalarType::kUint32);
  for (const char* name : {"x", "y", "z"}) {
    records.add_field(name, ScalarType::kFloat32);
  }
  for (const char* name : {"reflectivity", "tag", "line"}) {
    records.add_field(name, ScalarType::kUint8);
  }
  return records;
}

CloudMessage read_livox_custom(std::string_view bytes) {
  ByteCursor cursor(bytes);
  CloudMessage message;
  std::tie(message.stamp, message.frame) = header(cursor);
  cursor.next<std::uint64_t>();  // timebase: the stamp in ns
  cursor.next<std::uint32_t>();  // point_num: said again by the array
  cursor.block(4);               // lidar_id, rsvd
  message.records = livox_records();
  message.records.size = cursor.next<std::uint32_t>();
  message.records.bytes = cursor.block(message.records.size * message.records.record_size);
  return message;
}

ImuSample read_imu(std::string_view bytes) {
  constexpr std::size_t kCovariance = 9 * sizeof(double);
  ByteCursor cursor(bytes);
  ImuSample sample;
  sample.time = header(cursor).first;
  cursor.block(4 * sizeof(double) + kCovariance);  // orientation
  sample.gyro = vector(cursor);
  cursor.block(kCovariance);
  sample.accel = vector(cursor);
  cursor.block(kCovariance);
  return sample;
}

const std::string& bytes_of(const RecordedMessage& message) {
  if (!message.problem.empty()) {
    throw std::runtime_error(message.problem);
  }
  return message.bytes;
}

CloudMessage read_cloud(const RecordedMessage& message) {
  const std::string& bytes = bytes_of(message);
  CloudMessage cloud = is_livox(message.type) ? read_livox_custom(bytes) : read_point_cloud2(bytes);
  cloud.record_time = message.record_time;
  return cloud;
}

}  // namespace nvm::io
