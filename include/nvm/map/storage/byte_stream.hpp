// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "nvm/core/target.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

template <class T>
using BitsOf = std::conditional_t<
    sizeof(T) == 8,
    std::uint64_t,
    std::conditional_t<
        sizeof(T) == 4,
        std::uint32_t,
        std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;

/// Collects numbers as little-endian bytes.
class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    BitsOf<T> bits;
    std::memcpy(&bits, &value, sizeof(bits));
    for (std::size_t i = 0; i < sizeof(bits); ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(bits >> 8 * i));
    }
  }
  template <class = void>
  void append(const std::vector<std::uint8_t>& bytes) {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + bytes.size());
    std::copy(bytes.begin(), bytes.end(), bytes_.data() + end);
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Reads numbers back; throws std::runtime_error at the end.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* bytes, std::size_t size) : next_(bytes), left_(size) {}

  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    if (left_ < sizeof(T)) {
      throw std::runtime_error("ends too early");
    }
    BitsOf<T> bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bits = static_cast<BitsOf<T>>(
          bits | static_cast<BitsOf<T>>(static_cast<BitsOf<T>>(next_[i]) << 8 * i));
    }
    next_ += sizeof(T);
    left_ -= sizeof(T);
    T value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  std::size_t left() const { return left_; }

 private:
  const std::uint8_t* next_;
  std::size_t left_;
};

/// The CRC-32 of zip and PNG (polynomial 0xedb88320, reflected).
template <class = void>
std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size) {
  static constexpr auto kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value >> 1) ^ ((value & 1U) != 0 ? 0xedb88320U : 0U);
      }
      table[i] = value;
    }
    return table;
  }();
  std::uint32_t crc = 0xffffffffU;
  for (std::size_t i = 0; i < size; ++i) {
    crc = kTable[(crc ^ bytes[i]) & 0xffU] ^ (crc >> 8);
  }
  return ~crc;
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
