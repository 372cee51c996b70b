// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nvm::detail {

/// A key and the index that it belongs to.
struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

/// Stable sort by key, digit by digit from the lowest: linear in the number of items. `key_bits`
/// bits of the keys are in use. `scratch` is a buffer to be kept between calls.
inline void radix_sort(
    std::vector<KeyedIndex>& items, std::vector<KeyedIndex>& scratch, int key_bits) {
  constexpr int kDigitBits = 11;
  constexpr std::uint64_t kDigits = std::uint64_t{1} << kDigitBits;
  scratch.resize(items.size());
  for (int shift = 0; shift < key_bits; shift += kDigitBits) {
    const auto digit = [shift](const KeyedIndex& item) {
      return (item.key >> shift) & (kDigits - 1);
    };
    std::array<std::uint32_t, kDigits + 1> begin{};
    for (const KeyedIndex& item : items) {
      ++begin[digit(item) + 1];
    }
    for (std::size_t d = 0; d < kDigits; ++d) {
      begin[d + 1] += begin[d];
    }
    for (const KeyedIndex& item : items) {
      scratch[begin[digit(item)]++] = item;
    }
    items.swap(scratch);
  }
}

}  // namespace nvm::detail
