// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/ply_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "io/file/file.hpp"

namespace nvm::sim {

namespace {

enum class Number { kSigned, kUnsigned, kReal };

struct NumberType {
  std::string_view name, sized_name;
  Number number;
  std::size_t size;  ///< [bytes]
};

constexpr std::array<NumberType, 8> kNumberTypes{{
    {"char", "int8", Number::kSigned, 1},
    {"uchar", "uint8", Number::kUnsigned, 1},
    {"short", "int16", Number::kSigned, 2},
    {"ushort", "uint16", Number::kUnsigned, 2},
    {"int", "int32", Number::kSigned, 4},
    {"uint", "uint32", Number::kUnsigned, 4},
    {"float", "float32", Number::kReal, 4},
    {"double", "float64", Number::kReal, 8},
}};

const NumberType& type_named(const std::string& name) {
  const auto* type =
      std::find_if(kNumberTypes.begin(), kNumberTypes.end(), [&](const NumberType& known) {
        return name == known.name || name == known.sized_name;
      });
  if (type == kNumberTypes.end()) {
    throw std::runtime_error("property type '" + name + "' is not known");
  }
  return *type;
}

struct PlyProperty {
  std::optional<NumberType> count;  ///< of a list
  NumberType value;
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

  double next(const NumberType& type) {
    std::array<char, 8> bytes{};
    double value = 0.0;
    if (is_ascii_ ? !(text_ >> value)
                  : !text_.read(bytes.data(), static_cast<std::streamsize>(type.size))) {
      throw std::runtime_error("is cut off, or holds what is no number");
    }
    return is_ascii_ ? value : decoded(bytes, type);
  }

 private:
  double decoded(std::array<char, 8>& bytes, const NumberType& type) const {
    if (is_big_endian_) {
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.size));
    }
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes.data(), sizeof bits);
    const bool is_negative = type.number == Number::kSigned && type.size <= sizeof bits &&
                             (bits >> (8 * type.size - 1) & 1U) != 0;
    // Reals are no corners of faces, and what they are is of no interest here.
    const double modulus = std::ldexp(1.0, static_cast<int>(8 * type.size));
    return static_cast<double>(bits) - (is_negative ? modulus : 0.0);
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
      std::optional<NumberType> count;
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
