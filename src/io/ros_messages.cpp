// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/ros_messages.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace nvm::io {
namespace {

/// Takes values off the front of a serialised message.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  std::string_view block(std::size_t size) {
    if (size > rest_.size()) {
      throw std::runtime_error("the message is truncated");
    }
    const std::string_view block = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return block;
  }

  template <class T>
  T next() {
    T value{};
    std::memcpy(&value, block(sizeof(T)).data(), sizeof(T));
    return value;
  }

  /// A block after its size: a text, or an array of bytes.
  std::string_view sized_block() { return block(next<std::uint32_t>()); }

  /// The stamp [s] of a std_msgs/Header.
  double header() {
    next<std::uint32_t>();  // seq
    const auto seconds = next<std::uint32_t>();
    const auto nanoseconds = next<std::uint32_t>();
    sized_block();  // frame_id
    return seconds + 1e-9 * nanoseconds;
  }

  Eigen::Vector3d vector() {
    const auto x = next<double>();
    const auto y = next<double>();
    return {x, y, next<double>()};
  }

 private:
  std::string_view rest_;
};

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

std::vector<Field> point_fields(Cursor& cursor) {
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

/// The points of `data` without the padding between rows.
std::string packed_rows(
    std::string_view data, std::size_t height, std::size_t row_size, std::size_t row_step) {
  std::string bytes;
  for (std::size_t row = 0; row < height; ++row) {
    if (row * row_step > data.size() || row_size > data.size() - row * row_step) {
      throw std::runtime_error("the cloud has fewer data than its size says");
    }
    bytes += data.substr(row * row_step, row_size);
  }
  return bytes;
}

}  // namespace

CloudMessage read_point_cloud2(std::string_view bytes) {
  Cursor cursor(bytes);
  CloudMessage message;
  PointRecords& records = message.records;
  message.stamp = cursor.header();
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
  Cursor cursor(bytes);
  CloudMessage message;
  message.stamp = cursor.header();
  cursor.next<std::uint64_t>();  // timebase: the stamp in ns
  cursor.next<std::uint32_t>();  // point_num: said again by the array
  cursor.block(4);               // lidar_id, rsvd
  message.records = livox_records();
  message.records.size = cursor.next<std::uint32_t>();
  message.records.bytes = cursor.block(message.records.size * message.records.record_size);
  return message;
}

lio::ImuSample read_imu(std::string_view bytes) {
  constexpr std::size_t kCovariance = 9 * sizeof(double);
  Cursor cursor(bytes);
  lio::ImuSample sample;
  sample.time = cursor.header();
  cursor.block(4 * sizeof(double) + kCovariance);  // orientation
  sample.gyro = cursor.vector();
  cursor.block(kCovariance);
  sample.accel = cursor.vector();
  cursor.block(kCovariance);
  return sample;
}

}  // namespace nvm::io
