// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/cloud/pcd.hpp"

#include <array>
#include <optional>
#include <utility>

#include "io/cloud/lzf.hpp"
#include "io/file/file.hpp"
#include "io/file/line_reader.hpp"
#include "io/file/pending_path.hpp"

namespace nvm::io {
namespace {

constexpr std::size_t kMaxFieldCount = 1U << 20;

struct PcdType {
  char type;
  std::size_t size;
  ScalarType scalar;
};

constexpr std::array<PcdType, 10> kPcdTypes = {{
    {'I', 1, ScalarType::kInt8},
    {'U', 1, ScalarType::kUint8},
    {'I', 2, ScalarType::kInt16},
    {'U', 2, ScalarType::kUint16},
    {'I', 4, ScalarType::kInt32},
    {'U', 4, ScalarType::kUint32},
    {'I', 8, ScalarType::kInt64},
    {'U', 8, ScalarType::kUint64},
    {'F', 4, ScalarType::kFloat32},
    {'F', 8, ScalarType::kFloat64},
}};

/// The header's entries as they stand in the file.
struct PcdHeader {
  std::vector<std::string> names;
  std::vector<std::size_t> sizes;
  std::vector<std::string> types;
  std::vector<std::size_t> counts;
  std::optional<std::size_t> width;
  std::size_t height = 1;
  std::optional<std::size_t> points;
  std::string encoding;
  std::size_t end = 0;  ///< where the data begin [bytes]
};

class PcdHeaderParser {
 public:
  PcdHeaderParser(std::string path, std::string_view bytes)
      : path_(std::move(path)), bytes_(bytes) {}

  PcdHeader parse() {
    while (header_.encoding.empty()) {
      const std::size_t end = bytes_.find('\n', header_.end);
      if (end == std::string_view::npos) {
        fail(path_, "is no PCD file, or its header is truncated: no DATA line");
      }
      const std::string_view line = bytes_.substr(header_.end, end - header_.end);
      header_.end = end + 1;
      const auto words = split(line.substr(0, line.find('#')));
      if (!words.empty()) {
        take({words[0], {words.begin() + 1, words.end()}});
      }
    }
    return std::move(header_);
  }

 private:
  struct Entry {
    std::string_view key;
    std::vector<std::string_view> values;
  };

  void take(const Entry& entry) {
    if (entry.key == "FIELDS" || entry.key == "COLUMNS") {  // the latter before version 0.6
      header_.names.assign(entry.values.begin(), entry.values.end());
    } else if (entry.key == "SIZE") {
      header_.sizes = numbers(entry);
    } else if (entry.key == "TYPE") {
      header_.types.assign(entry.values.begin(), entry.values.end());
    } else if (entry.key == "COUNT") {
      header_.counts = numbers(entry);
    } else if (entry.key == "WIDTH") {
      header_.width = number(entry);
    } else if (entry.key == "HEIGHT") {
      header_.height = number(entry);
    } else if (entry.key == "POINTS") {
      header_.points = number(entry);
    } else if (entry.key == "DATA") {
      header_.encoding = entry.values.empty() ? "nothing" : std::string(entry.values[0]);
    } else if (entry.key != "VERSION" && entry.key != "VIEWPOINT") {
      fail(path_, "is no PCD file: unknown header entry " + quote(entry.key));
    }
  }

  std::vector<std::size_t> numbers(const Entry& entry) const {
    std::vector<std::size_t> numbers;
    for (const std::string_view word : entry.values) {
      const auto number = parse_whole_number(word);
      if (!number) {
        fail(path_, std::string(entry.key) + " " + quote(word) + " is no whole number");
      }
      numbers.push_back(*number);
    }
    return numbers;
  }

  std::size_t number(const Entry& entry) const {
    const auto all = numbers(entry);
    if (all.size() != 1) {
      fail(path_, std::string(entry.key) + " must have one value");
    }
    return all[0];
  }

  std::string path_;
  std::string_view bytes_;
  PcdHeader header_;
};

ScalarType scalar_type(const std::string& path, const std::string& type, std::size_t size) {
  for (const PcdType& known : kPcdTypes) {
    if (type.size() == 1 && type[0] == known.type && size == known.size) {
      return known.scalar;
    }
  }
  fail(
      path, "field of TYPE " + quote(type) + " and SIZE " + std::to_string(size) + " is not known");
}

/// The number of points that WIDTH, HEIGHT and POINTS agree on.
std::size_t point_count(const std::string& path, const PcdHeader& header) {
  const std::size_t width = header.width.value_or(header.points.value_or(0));
  std::size_t count = 0;
  if ((!header.width && !header.points) || __builtin_mul_overflow(width, header.height, &count) ||
      count != header.points.value_or(count)) {
    fail(path, "WIDTH, HEIGHT and POINTS are missing or contradict each other");
  }
  return count;
}

PointRecords records_of(const std::string& path, const PcdHeader& header) {
  const std::size_t fields = header.names.size();
  if (fields == 0 || header.sizes.size() != fields || header.types.size() != fields ||
      (!header.counts.empty() && header.counts.size() != fields)) {
    fail(path, "FIELDS, SIZE, TYPE and COUNT are missing or differ in length");
  }
  PointRecords records;
  records.source = path;
  records.size = point_count(path, header);
  for (std::size_t i = 0; i < fields; ++i) {
    const std::size_t count = header.counts.empty() ? 1 : header.counts[i];
    if (count > kMaxFieldCount) {
      fail(
          path,
          "COUNT " + std::to_string(count) + " of field " + quote(header.names[i]) + " is above " +
              std::to_string(kMaxFieldCount));
    }
    if (count == 0) {  // a field without bytes
      continue;
    }
    records.add_field(header.names[i], scalar_type(path, header.types[i], header.sizes[i]), count);
  }
  return records;
}

/// Turns the field-by-field order of compressed files into records.
std::string interleave(const std::string& columns, const PointRecords& records) {
  std::string bytes(columns.size(), '\0');
  const char* from = columns.data();
  for (const Field& field : records.fields) {
    const std::size_t width = size_of(field.type) * field.count;
    for (std::size_t i = 0; i < records.size; ++i, from += width) {
      std::memcpy(&bytes[i * records.record_size + field.offset], from, width);
    }
  }
  return bytes;
}

void read_compressed(std::string_view data, PointRecords& records) {
  std::array<std::uint32_t, 2> sizes{};  // compressed, expanded
  if (records.size == 0) {
    return;
  }
  if (data.size() < sizeof(sizes)) {
    fail(records.source, "is truncated: the sizes of the compressed data are missing");
  }
  std::memcpy(sizes.data(), data.data(), sizeof(sizes));
  data.remove_prefix(sizeof(sizes));
  if (sizes[0] > data.size()) {
    fail(
        records.source,
        "is truncated: " + std::to_string(data.size()) + " of " + std::to_string(sizes[0]) +
            " compressed bytes");
  }
  if (sizes[1] % records.record_size != 0 || sizes[1] / records.record_size != records.size) {
    fail(records.source, "is corrupt: the compressed data are not as long as the header says");
  }
  const auto columns = lzf_decompress(data.substr(0, sizes[0]), sizes[1]);
  if (!columns) {
    fail(records.source, "is corrupt: the compressed data cannot be expanded");
  }
  records.bytes = interleave(*columns, records);
}

}  // namespace

PointRecords read_pcd(const std::string& path) {
  std::string bytes = read_file(path);
  const PcdHeader header = PcdHeaderParser(path, bytes).parse();
  PointRecords records = records_of(path, header);
  if (header.encoding == "ascii") {
    append_text_records(std::string_view(bytes).substr(header.end), records);
  } else if (header.encoding == "binary") {
    records.bytes = std::move(bytes.erase(0, header.end));
  } else if (header.encoding == "binary_compressed") {
    read_compressed(std::string_view(bytes).substr(header.end), records);
  } else {
    fail(path, "DATA " + quote(header.encoding) + " is not known");
  }
  return checked(std::move(records));
}

void write_pcd(const std::string& path, const PointRecords& records) {
  std::string names;
  std::string sizes;
  std::string types;
  std::string counts;
  for (const Field& field : records.fields) {
    for (const PcdType& known : kPcdTypes) {
      if (known.scalar == field.type) {
        types += std::string(" ") + known.type;
      }
    }
    names += " " + field.name;
    sizes += " " + std::to_string(size_of(field.type));
    counts += " " + std::to_string(field.count);
  }
  AtomicFile file(path);
  file.stream() << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS" << names
                << "\nSIZE" << sizes << "\nTYPE" << types << "\nCOUNT" << counts << "\nWIDTH "
                << records.size << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << records.size
                << "\nDATA binary\n"
                << records.bytes;
  file.commit();
}

}  // namespace nvm::io
