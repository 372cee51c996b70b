// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// For each set of bits in a byte: how many they are, and which, in ascending order.
struct BitPositions {
  struct Row {
    std::uint32_t count = 0;
    std::uint32_t position[8] = {};
  };
  std::array<Row, 256> rows{};

  constexpr BitPositions() {
    for (std::size_t byte = 0; byte < rows.size(); ++byte) {
      for (std::uint32_t bit = 0; bit < 8; ++bit) {
        if ((byte >> bit) & 1U) {
          rows[byte].position[rows[byte].count++] = bit;
        }
      }
    }
  }
};

template <class>
inline constexpr BitPositions kBitPositions{};

/// A list of node numbers on the stack.
class NodeList {
 public:
  static constexpr std::size_t kCapacity = 128;

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  std::uint32_t operator[](std::size_t i) const { return items_[i]; }
  /// Whether append() may not have room.
  bool is_full() const { return size_ + 8 > kCapacity; }

  void push(std::uint32_t item) { items_[size_++] = item; }
  std::uint32_t pop() { return items_[--size_]; }
  void clear() { size_ = 0; }

  /// Appends first + i for each set bit i of `bits`, at most eight, without a branch.
  template <class Unused = void>
  void append(std::uint32_t first, std::uint32_t bits) {
    const BitPositions::Row& row = kBitPositions<Unused>.rows[bits];
    for (std::size_t i = 0; i < 8; ++i) {
      items_[size_ + i] = first + row.position[i];
    }
    size_ += row.count;
  }

 private:
  std::array<std::uint32_t, kCapacity> items_;
  std::size_t size_ = 0;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
