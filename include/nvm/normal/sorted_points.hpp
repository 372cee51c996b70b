// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "nvm/core/target.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Points in an order in which those that follow each other lie near each other, as a structure of
/// arrays: local coordinates [m], the squared radius of their neighbourhoods [m^2], and where each
/// stood before. The arrays of floats end with NaN up to a multiple of kPadding, which is one of
/// kLaneCount on every target: such a point is no one's neighbour and has none.
struct SortedPoints {
  static constexpr std::size_t kPadding = 8;

  std::vector<float> x, y, z, sq_radius;
  std::vector<std::uint32_t> index;

  std::size_t size() const { return index.size(); }
  const std::vector<float>& coordinate(std::size_t axis) const {
    return axis == 0 ? x : axis == 1 ? y : z;
  }

  template <class = void>
  void resize(std::size_t size) {
    index.resize(size);
    const std::size_t padded = (size + kPadding - 1) / kPadding * kPadding;
    for (std::vector<float>* values : {&x, &y, &z, &sq_radius}) {
      values->resize(padded);
      for (std::size_t i = size; i < padded; ++i) {
        (*values)[i] = std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
