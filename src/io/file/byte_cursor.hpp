// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace nvm::io {

/// Takes values off the front of bytes, little endian. Every member throws std::runtime_error when
/// they are fewer than it takes.
class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes) : rest_(bytes) {}

  bool is_at_end() const { return rest_.empty(); }
  std::size_t left() const { return rest_.size(); }

  std::string_view block(std::size_t size) {
    if (size > rest_.size()) {
      throw std::runtime_error("is truncated: a length goes beyond the end");
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

 private:
  std::string_view rest_;
};

}  // namespace nvm::io
