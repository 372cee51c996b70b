// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/target.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// A key and the index that it belongs to.
struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

/// Stable sort by key, digit by digit from the lowest: linear in the number of items. Only the
/// lowest `key_bits` bits of the keys are in use. `scratch` is a buffer to be kept between calls.
template <class = void>
void radix_sort(std::vector<KeyedIndex>& items, std::vector<KeyedIndex>& scratch, int key_bits) {
  constexpr int kMaxDigitBits = 12;
  constexpr std::size_t kMaxDigits = std::size_t{1} << kMaxDigitBits;
  const int passes = (key_bits + kMaxDigitBits - 1) / kMaxDigitBits;
  const int digit_bits = passes > 0 ? (key_bits + passes - 1) / passes : 0;
  const std::size_t digits = std::size_t{1} << digit_bits;
  scratch.resize(items.size());
  for (int pass = 0; pass < passes; ++pass) {
    const auto digit = [shift = pass * digit_bits, mask = digits - 1](const KeyedIndex& item) {
      return static_cast<std::size_t>((item.key >> shift) & mask);
    };
    std::array<std::uint32_t, kMaxDigits + 1> begin;
    std::fill_n(begin.begin(), digits + 1, 0U);
    for (const KeyedIndex& item : items) {
      ++begin[digit(item) + 1];
    }
    for (std::size_t d = 0; d < digits; ++d) {
      begin[d + 1] += begin[d];
    }
    for (const KeyedIndex& item : items) {
      scratch[begin[digit(item)]++] = item;
    }
    items.swap(scratch);
  }
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
