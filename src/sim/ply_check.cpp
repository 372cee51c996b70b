// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/ply_check.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "io/cloud/ply.hpp"
#include "io/file/file.hpp"

namespace nvm::sim {

namespace {

io::ScalarType type_named(const std::string& name) {
  const auto type = io::ply_type(name);
  if (!type) {
    throw std::runtime_error("property type '" + name + "' is not known");
  }
  return *type;
}

struct PlyProperty {
  std::optional<io::ScalarType> count;  ///< of a list
  io::ScalarType value;
  bool is_corners;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// The numbers behind the header, one after the other.
class PlyBody {
 public:
  PlyBody(std::string bytes, const std::string& encoding)
      : text_(std::move(bytes)),
        is_ascii_(encoding == "ascii"),
        is_big_endian_(encoding == "binary_big_endian") {}

  double next(io::ScalarType type) {
    std::array<char, 8> bytes{};
    double value = 0.0;
    if (is_ascii_ ? !(text_ >> value)
                  : !text_.read(bytes.data(), static_cast<std::streamsize>(io::size_of(type)))) {
      throw std::runtime_error("is cut off, or holds what is no number");
    }
    return is_ascii_ ? value : decoded(bytes, type);
  }

 private:
  double decoded(std::array<char, 8>& bytes, io::ScalarType type) const {
    if (is_big_endian_) {
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(io::size_of(type)));
    }
    return io::visit_type(type, [&](auto value) {
      std::memcpy(&value, bytes.data(), sizeof value);
      return static_cast<double>(value);
    });
  }

  std::istringstream text_;
  bool is_ascii_, is_big_endian_;
};

std::vector<PlyElement> read_header(std::istream& file, std::string& encoding) {
  std::vector<PlyElement> elements;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word >> type;
    if (word == "end_header") {
      return elements;
    }
    if (word == "format") {
      encoding = type;
    } else if (word == "element") {
      elements.push_back({type, 0, {}});
      words >> elements.back().count;
    } else if (word == "property" && !elements.empty()) {
      std::optional<io::ScalarType> count;
      if (type == "list") {
        words >> name >> type;
        count = type_named(name);
      }
      words >> name;
      const bool is_corners = name == "vertex_indices" || name == "vertex_index";
      elements.back().properties.push_back({count, type_named(type), is_corners});
    }
  }
  throw std::runtime_error("its header is cut off: no end_header");
}

void check_numbers(const PlyElement& element, std::uint64_t vertices, PlyBody& body) {
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    for (const PlyProperty& property : element.properties) {
      const double count = property.count ? body.next(*property.count) : 1.0;
      for (double k = 0.0; k < count; k += 1.0) {
        const double value = body.next(property.value);
        if (property.is_corners && !(value >= 0.0 && value < static_cast<double>(vertices))) {
          throw std::runtime_error(
              "face " + std::to_string(i) + " has a corner that is none of its " +
              std::to_string(vertices) + " vertices");
        }
      }
    }
  }
}

}  // namespace

void check_ply(const std::string& path) {
  std::istringstream file(io::read_file(path));
  try {
    std::string encoding;
    const std::vector<PlyElement> elements = read_header(file, encoding);
    const auto begin = static_cast<std::size_t>(file.tellg());
    PlyBody body(file.str().substr(begin), encoding);
    std::uint64_t vertices = 0;
    for (const PlyElement& element : elements) {
      vertices = element.name == "vertex" ? element.count : vertices;
      check_numbers(element, vertices, body);
    }
  } catch (const std::runtime_error& error) {
    io::fail(path, error.what());
  }
}

}  // namespace nvm::sim
