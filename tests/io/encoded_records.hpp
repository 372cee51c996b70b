// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "io/cloud/point_records.hpp"
#include "io/lzf_compress.hpp"

namespace nvm::test {

inline constexpr io::ScalarType kAllTypes[] = {
    io::ScalarType::kInt8,
    io::ScalarType::kUint8,
    io::ScalarType::kInt16,
    io::ScalarType::kUint16,
    io::ScalarType::kInt32,
    io::ScalarType::kUint32,
    io::ScalarType::kInt64,
    io::ScalarType::kUint64,
    io::ScalarType::kFloat32,
    io::ScalarType::kFloat64};

/// The values of the field `name`; none without it.
inline std::vector<double> column(const io::PointRecords& records, const char* name) {
  std::vector<double> values;
  if (const io::Field* field = records.find({name})) {
    io::for_each_value(
        records, *field, [&](std::size_t, double value) { values.push_back(value); });
  }
  return values;
}

/// Random whole numbers in fields of all types, in random order, some with a count above 1.
inline io::PointRecords random_records(std::mt19937_64& rng, bool only_ply_types) {
  io::PointRecords records;
  const std::size_t field_count = 1 + rng() % 8;
  for (std::size_t i = 0; i < field_count; ++i) {
    const io::ScalarType type = kAllTypes[rng() % 10];
    const bool is_long = type == io::ScalarType::kInt64 || type == io::ScalarType::kUint64;
    const std::string name = "f" + std::to_string(i);
    if (only_ply_types) {
      records.add_field(name, is_long ? io::ScalarType::kUint8 : type);
    } else {
      records.add_field(name, type, 1 + rng() % 3);
    }
  }
  records.size = rng() % 20;
  for (std::size_t i = 0; i < records.size; ++i) {
    for (const io::Field& field : records.fields) {
      for (std::size_t k = 0; k < field.count; ++k) {
        io::visit_type(field.type, [&](auto zero) {
          io::append_bytes(static_cast<decltype(zero)>(rng() % 128), records.bytes);
        });
      }
    }
  }
  return records;
}

/// The values of `records` as text, one record a line.
inline std::string text_of(const io::PointRecords& records) {
  std::string text;
  for (std::size_t i = 0; i < records.size; ++i) {
    for (const io::Field& field : records.fields) {
      for (std::size_t k = 0; k < field.count; ++k) {
        io::visit_type(field.type, [&](auto value) {
          const std::size_t at = i * records.record_size + field.offset + k * sizeof(value);
          std::memcpy(&value, &records.bytes[at], sizeof(value));
          text += std::to_string(value) + " ";
        });
      }
    }
    text += "\n";
  }
  return text;
}

/// The bytes of `records` in big endian.
inline std::string big_endian(io::PointRecords records) {
  for (std::size_t i = 0; i < records.size; ++i) {
    for (const io::Field& field : records.fields) {
      const auto begin = records.bytes.begin() +
                         static_cast<std::ptrdiff_t>(i * records.record_size + field.offset);
      std::reverse(begin, begin + static_cast<std::ptrdiff_t>(io::size_of(field.type)));
    }
  }
  return records.bytes;
}

/// `binary_pcd`, a PCD file of `records`, with its data compressed.
inline std::string compressed_pcd(const std::string& binary_pcd, const io::PointRecords& records) {
  std::string columns;
  for (const io::Field& field : records.fields) {
    for (std::size_t i = 0; i < records.size; ++i) {
      columns += records.bytes.substr(
          i * records.record_size + field.offset, io::size_of(field.type) * field.count);
    }
  }
  const std::string compressed = lzf_compress(columns);
  std::string file = binary_pcd.substr(0, binary_pcd.find("DATA")) + "DATA binary_compressed\n";
  io::append_bytes(static_cast<std::uint32_t>(compressed.size()), file);
  io::append_bytes(static_cast<std::uint32_t>(columns.size()), file);
  return file + compressed;
}

inline std::string pcd_header(const std::string& lines) {
  return "# .PCD v0.7\nVERSION 0.7\n" + lines;
}

}  // namespace nvm::test
