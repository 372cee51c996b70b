// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/file/byte_cursor.hpp"

namespace nvm::io {

/// A record of a ROS 1 bag (http://wiki.ros.org/Bags/Format/2.0): a header of fields and its data.
/// Views into the bytes it was read from.
class RosBagRecord {
 public:
  enum Operation : std::uint8_t {
    kMessage = 2,
    kBagHeader = 3,
    kIndex = 4,
    kChunk = 5,
    kChunkInfo = 6,
    kConnection = 7
  };

  /// Takes the whole record off `cursor`. Throws std::runtime_error.
  explicit RosBagRecord(ByteCursor& cursor)
      : fields_(fields_of(cursor.sized_block())), data_(cursor.sized_block()) {}

  /// The header alone.
  explicit RosBagRecord(std::string_view header) : fields_(fields_of(header)) {}

  std::uint8_t operation() const { return number<std::uint8_t>("op"); }
  std::string_view data() const { return data_; }

  bool has(std::string_view name) const { return fields_.count(name) > 0; }

  /// Throws std::runtime_error without such a field.
  std::string_view text(std::string_view name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) {
      throw std::runtime_error("is corrupt: a record has no field " + std::string(name));
    }
    return found->second;
  }

  template <class Number>
  Number number(std::string_view name) const {
    return ByteCursor(text(name)).next<Number>();
  }

  /// The fields "name=value" of a header. Throws std::runtime_error.
  static std::map<std::string_view, std::string_view> fields_of(std::string_view header) {
    std::map<std::string_view, std::string_view> fields;
    for (ByteCursor cursor(header); !cursor.is_at_end();) {
      const std::string_view field = cursor.sized_block();
      const std::size_t equals = field.find('=');
      if (equals == std::string_view::npos) {
        throw std::runtime_error("is corrupt: a header has a field without '='");
      }
      fields[field.substr(0, equals)] = field.substr(equals + 1);
    }
    return fields;
  }

 private:
  std::map<std::string_view, std::string_view> fields_;
  std::string_view data_;
};

}  // namespace nvm::io
