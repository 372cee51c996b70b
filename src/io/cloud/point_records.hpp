// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace nvm::io {

enum class ScalarType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};

/// Calls `visitor` with a value of the C++ type that `type` stands for.
template <class Visitor>
auto visit_type(ScalarType type, const Visitor& visitor) {
  switch (type) {
    case ScalarType::kInt8:
      return visitor(std::int8_t{});
    case ScalarType::kUint8:
      return visitor(std::uint8_t{});
    case ScalarType::kInt16:
      return visitor(std::int16_t{});
    case ScalarType::kUint16:
      return visitor(std::uint16_t{});
    case ScalarType::kInt32:
      return visitor(std::int32_t{});
    case ScalarType::kUint32:
      return visitor(std::uint32_t{});
    case ScalarType::kInt64:
      return visitor(std::int64_t{});
    case ScalarType::kUint64:
      return visitor(std::uint64_t{});
    case ScalarType::kFloat32:
      return visitor(float{});
    case ScalarType::kFloat64:
      break;
  }
  return visitor(double{});
}

std::size_t size_of(ScalarType type);
bool is_integer(ScalarType type);

/// A named member of a point record: `count` values side by side.
struct Field {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  std::size_t count = 1;
  std::size_t offset = 0;  ///< [bytes] from the begin of the record
};

/// Points as files and messages hold them: records of equal size with any fields. PCD, PLY, KITTI
/// and PointCloud2 are all read into this form and written from it.
struct PointRecords {
  std::string source;  ///< file or topic, for error messages
  std::vector<Field> fields;
  std::size_t record_size = 0;  ///< [bytes]
  std::size_t size = 0;         ///< number of points
  std::string bytes;            ///< size * record_size
  bool is_big_endian = false;
  std::size_t missing = 0;  ///< points that the header announces behind the end of the file

  /// Appends a field to the record.
  void add_field(const std::string& name, ScalarType type, std::size_t count = 1);

  /// The first field with one of the names; nullptr without one.
  const Field* find(std::initializer_list<std::string_view> names) const;
};

/// Appends the bytes of `value`, little endian.
template <class T>
void append_bytes(T value, std::string& bytes) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Appends up to `records.size` records written as lines of numbers; those that are not there count
/// as missing. Fields of whole numbers become float64 where one is not whole. Throws
/// std::runtime_error.
void append_text_records(std::string_view text, PointRecords& records);

/// `records` without bytes behind the last record, and without records behind the last byte, which
/// count as missing. Throws std::runtime_error unless all fields lie in the record, and when no
/// record is there although some are announced.
PointRecords checked(PointRecords records);

/// Calls `visitor(index, value)` with the first value of `field` in each record, as a double.
template <class Visitor>
void for_each_value(const PointRecords& records, const Field& field, const Visitor& visitor) {
  visit_type(field.type, [&](auto zero) {
    const char* from = records.bytes.data() + field.offset;
    for (std::size_t i = 0; i < records.size; ++i, from += records.record_size) {
      char raw[sizeof(zero)];
      std::memcpy(raw, from, sizeof(raw));
      if (records.is_big_endian) {
        std::reverse(raw, raw + sizeof(raw));
      }
      auto value = zero;
      std::memcpy(&value, raw, sizeof(raw));
      visitor(i, static_cast<double>(value));
    }
  });
}

/// Reads a scan or map file by its extension: .pcd, .ply, .bin (of `bin_fields` numbers a point,
/// see read_kitti_points). One that is cut off is read as far as it goes. Throws
/// std::runtime_error.
PointRecords read_points(const std::string& path, std::size_t bin_fields = 0);

}  // namespace nvm::io
