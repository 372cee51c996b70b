// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/cloud/ply.hpp"

#include <array>
#include <utility>

#include "io/file/file.hpp"
#include "io/file/line_reader.hpp"
#include "io/file/pending_path.hpp"

namespace nvm::io {
namespace {

struct PlyType {
  std::string_view name;
  std::string_view sized_name;
  ScalarType scalar;
};

constexpr std::array<PlyType, 8> kPlyTypes = {{
    {"char", "int8", ScalarType::kInt8},
    {"uchar", "uint8", ScalarType::kUint8},
    {"short", "int16", ScalarType::kInt16},
    {"ushort", "uint16", ScalarType::kUint16},
    {"int", "int32", ScalarType::kInt32},
    {"uint", "uint32", ScalarType::kUint32},
    {"float", "float32", ScalarType::kFloat32},
    {"double", "float64", ScalarType::kFloat64},
}};

struct Element {
  std::string name;
  bool has_list = false;
  PointRecords records;
};

struct PlyHeader {
  std::string encoding;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< where the data begin [bytes]
};

class PlyHeaderParser {
 public:
  PlyHeaderParser(std::string path, std::string_view bytes)
      : path_(std::move(path)), bytes_(bytes) {}

  PlyHeader parse() {
    if (next_line() != std::vector<std::string_view>{"ply"}) {
      fail(path_, "is no PLY file: it does not begin with 'ply'");
    }
    while (true) {
      const auto words = next_line();
      if (words.size() == 1 && words[0] == "end_header") {
        return std::move(header_);
      }
      if (!words.empty() && words[0] != "comment" && words[0] != "obj_info") {
        take(words);
      }
    }
  }

 private:
  std::vector<std::string_view> next_line() {
    const std::size_t end = bytes_.find('\n', header_.end);
    if (end == std::string_view::npos) {
      fail(path_, "is no PLY file, or its header is truncated: no end_header");
    }
    const std::string_view line = bytes_.substr(header_.end, end - header_.end);
    header_.end = end + 1;
    return split(line);
  }

  void take(const std::vector<std::string_view>& words) {
    if (words[0] == "format" && words.size() == 3) {
      header_.encoding = words[1];
    } else if (words[0] == "element" && words.size() == 3) {
      add_element(words[1], words[2]);
    } else if (words[0] == "property" && words.size() >= 3 && !header_.elements.empty()) {
      Element& element = header_.elements.back();
      element.has_list = element.has_list || words[1] == "list";
      if (words[1] != "list") {
        element.records.add_field(std::string(words[2]), scalar_type(words[1]));
      }
    } else {
      fail(path_, "unknown header line of " + quote(words[0]));
    }
  }

  void add_element(std::string_view name, std::string_view count) {
    Element element;
    element.name = name;
    element.records.source = path_;
    const auto size = parse_whole_number(count);
    if (!size) {
      fail(path_, "element count " + quote(count) + " is no whole number");
    }
    element.records.size = *size;
    header_.elements.push_back(std::move(element));
  }

  ScalarType scalar_type(std::string_view name) const {
    if (const auto type = ply_type(name)) {
      return *type;
    }
    fail(path_, "property type " + quote(name) + " is not known");
  }

  std::string path_;
  std::string_view bytes_;
  PlyHeader header_;
};

/// Moves `data` behind the elements that stand before the vertices and gives those.
PointRecords skip_to_vertices(PlyHeader& header, const std::string& path, std::string_view& data) {
  for (Element& element : header.elements) {
    const PointRecords& records = element.records;
    if (element.has_list) {
      fail(path, "list properties in element " + quote(element.name) + " are not supported");
    }
    if (element.name == "vertex") {
      return std::move(element.records);
    }
    if (header.encoding == "ascii") {
      for (std::size_t i = 0; i < records.size && !data.empty(); ++i) {
        data.remove_prefix(std::min(data.find('\n'), data.size() - 1) + 1);
      }
    } else if (records.record_size > 0) {
      const std::size_t room = data.size() / records.record_size;
      data.remove_prefix(std::min(records.size, room) * records.record_size);
    }
  }
  fail(path, "has no element 'vertex'");
}

}  // namespace

std::optional<ScalarType> ply_type(std::string_view name) {
  for (const PlyType& known : kPlyTypes) {
    if (name == known.name || name == known.sized_name) {
      return known.scalar;
    }
  }
  return std::nullopt;
}

PointRecords read_ply(const std::string& path) {
  const std::string bytes = read_file(path);
  PlyHeader header = PlyHeaderParser(path, bytes).parse();
  std::string_view data = std::string_view(bytes).substr(header.end);
  PointRecords records = skip_to_vertices(header, path, data);
  if (header.encoding == "ascii") {
    append_text_records(data, records);
  } else if (header.encoding == "binary_little_endian" || header.encoding == "binary_big_endian") {
    records.is_big_endian = header.encoding == "binary_big_endian";
    records.bytes = data;
  } else {
    fail(path, "format " + quote(header.encoding) + " is not known");
  }
  return checked(std::move(records));
}

void write_ply(const std::string& path, const PointRecords& records) {
  AtomicFile file(path);
  file.stream() << "ply\nformat binary_little_endian 1.0\nelement vertex " << records.size << '\n';
  for (const Field& field : records.fields) {
    for (const PlyType& known : kPlyTypes) {
      if (known.scalar == field.type) {
        file.stream() << "property " << known.name << ' ' << field.name << '\n';
      }
    }
  }
  file.stream() << "end_header\n" << records.bytes;
  file.commit();
}

}  // namespace nvm::io
