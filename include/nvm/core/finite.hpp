// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdint>
#include <cstring>

#include "nvm/core/target.hpp"

// Tests of a number's bits: they see NaN and infinity where -ffast-math lets the compiler assume
// that there are none.
namespace nvm::detail {
inline namespace NVM_TARGET {

/// Orders the absolute values of numbers as the numbers, infinity after them, NaN last.
inline std::uint64_t magnitude(double value) noexcept {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits & 0x7fffffffffffffffU;
}

inline bool is_finite(double value) noexcept { return magnitude(value) < 0x7ff0000000000000U; }

/// True for what is not NaN: for a corner of a box, which may lie at infinity.
inline bool is_number(double value) noexcept { return magnitude(value) <= 0x7ff0000000000000U; }

/// True for zero, positive numbers and infinity.
inline bool is_distance(double value) noexcept { return is_number(value) && value >= 0.0; }

template <class Matrix, class Condition>
bool holds_for_all(const Matrix& matrix, const Condition& holds) noexcept {
  bool result = true;
  for (decltype(matrix.rows()) i = 0; i < matrix.rows(); ++i) {
    for (decltype(matrix.cols()) j = 0; j < matrix.cols(); ++j) {
      result = result && holds(static_cast<double>(matrix(i, j)));
    }
  }
  return result;
}

/// For an Eigen vector or matrix of floats or doubles.
template <class Matrix>
bool all_finite(const Matrix& matrix) noexcept {
  return holds_for_all(matrix, [](double value) { return is_finite(value); });
}

template <class Matrix>
bool all_numbers(const Matrix& matrix) noexcept {
  return holds_for_all(matrix, [](double value) { return is_number(value); });
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
