// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/cloud/point_records.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "config/value.hpp"
#include "io/cloud/kitti.hpp"
#include "io/cloud/pcd.hpp"
#include "io/cloud/ply.hpp"
#include "io/file/file.hpp"
#include "io/file/line_reader.hpp"

namespace nvm::io {

namespace {

/// Appends the number that `word` spells as a `type`; false when it is none or does not fit.
bool append_parsed(std::string_view word, ScalarType type, std::string& bytes) {
  return visit_type(type, [&](auto value) {
    using T = decltype(value);
    if constexpr (std::is_floating_point_v<T>) {
      const auto number = config::parse_number(word);
      if (!number ||
          (std::isfinite(*number) && std::abs(*number) > std::numeric_limits<T>::max())) {
        return false;
      }
      append_bytes(static_cast<T>(*number), bytes);
      return true;
    } else {
      const char* end = word.data() + word.size();
      const auto [rest, error] = std::from_chars(word.data(), end, value);
      append_bytes(value, bytes);
      return error == std::errc() && rest == end;
    }
  });
}

/// Appends the values of one line; false when they are too many, too few, or no such numbers.
bool append_text_record(const std::vector<std::string_view>& words, PointRecords& records) {
  std::size_t at = 0;
  for (const Field& field : records.fields) {
    for (std::size_t i = 0; i < field.count; ++i) {
      if (at == words.size() || !append_parsed(words[at++], field.type, records.bytes)) {
        return false;
      }
    }
  }
  return at == words.size();
}

/// Makes float64 of the fields of whole numbers that are not whole in `words`, and begins again
/// without records; false, and no change, when there are none.
bool widen_whole_numbers(const std::vector<std::string_view>& words, PointRecords& records) {
  PointRecords wider;
  bool has_changed = false;
  std::size_t at = 0;
  for (const Field& field : records.fields) {
    ScalarType type = field.type;
    for (std::size_t i = 0; i < field.count && at < words.size(); ++i) {
      std::string ignored;
      const std::string_view word = words[at++];
      if (is_integer(field.type) && !append_parsed(word, field.type, ignored) &&
          config::parse_number(word)) {
        type = ScalarType::kFloat64;
        has_changed = true;
      }
    }
    wider.add_field(field.name, type, field.count);
  }
  if (has_changed) {
    records.fields = std::move(wider.fields);
    records.record_size = wider.record_size;
    records.bytes.clear();
  }
  return has_changed;
}

}  // namespace

std::size_t size_of(ScalarType type) {
  return visit_type(type, [](auto zero) { return sizeof(zero); });
}

bool is_integer(ScalarType type) {
  return visit_type(type, [](auto zero) { return std::is_integral_v<decltype(zero)>; });
}

void PointRecords::add_field(const std::string& name, ScalarType type, std::size_t count) {
  fields.push_back({name, type, count, record_size});
  record_size += size_of(type) * count;
}

const Field* PointRecords::find(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) {
    for (const Field& field : fields) {
      if (field.name == name) {
        return &field;
      }
    }
  }
  return nullptr;
}

void append_text_records(std::string_view text, PointRecords& records) {
  const std::string_view whole = text;
  std::size_t point = 0;
  while (point < records.size && !text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    const auto words = split(text.substr(0, end + 1));
    text.remove_prefix(end + 1);
    if (!words.empty() && !append_text_record(words, records)) {
      if (widen_whole_numbers(words, records)) {
        return append_text_records(whole, records);
      }
      if (text.empty() && point > 0) {
        break;  // cut off within a line
      }
      fail(records.source, "point " + std::to_string(point) + " is not one number per field");
    }
    point += words.empty() ? 0 : 1;
  }
  records.bytes.resize(point * records.record_size);
}

PointRecords checked(PointRecords records) {
  const std::size_t record_size = records.record_size;
  for (const Field& field : records.fields) {
    const std::size_t room = record_size - std::min(field.offset, record_size);
    if (field.count == 0 || field.count > room / size_of(field.type)) {
      fail(
          records.source,
          "field " + quote(field.name) + " does not fit into a record of " +
              std::to_string(record_size) + " bytes");
    }
  }
  const std::size_t there = record_size == 0 ? 0 : records.bytes.size() / record_size;
  if (records.size > 0 && there == 0) {
    fail(
        records.source,
        "is truncated: " + std::to_string(records.size) + " points of " +
            std::to_string(record_size) + " bytes are announced, " +
            std::to_string(records.bytes.size()) + " bytes are there");
  }
  records.missing = records.size - std::min(records.size, there);
  records.size -= records.missing;
  records.bytes.resize(records.size * record_size);
  return records;
}

PointRecords read_points(const std::string& path, std::size_t bin_fields) {
  const std::string extension = extension_of(path);
  if (extension == ".pcd") {
    return read_pcd(path);
  }
  if (extension == ".ply") {
    return read_ply(path);
  }
  if (extension == ".bin") {
    return read_kitti_points(path, bin_fields);
  }
  fail(path, "is not a .pcd, .ply or .bin file");
}

}  // namespace nvm::io
