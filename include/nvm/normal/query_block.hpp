// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_NORMAL_QUERY_BLOCK_HPP  // a kernel: nvm/core/target.hpp
#define NVM_NORMAL_QUERY_BLOCK_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/geometry/float_lanes.hpp"
#include "nvm/normal/sorted_points.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Squared length [m^2]: of the difference of two points, it is compared to the squared radius. A
/// neighbour is a point with sq_length <= sq_radius, inclusive, whatever finds it.
template <class Real>
Real sq_length(const Real& x, const Real& y, const Real& z) {
  return multiply_add<Real>(z, z, multiply_add<Real>(y, y, x * x));
}

/// Consecutive sorted queries, one per lane, and the box around them.
template <class Lanes>
struct BasicQueryBlock {
  static constexpr std::size_t kSize = sizeof(Lanes) / sizeof(float);
  static_assert(SortedPoints::kPadding % kSize == 0, "whole blocks can be loaded");

  const SortedPoints& queries;
  std::size_t begin, end;
  Lanes x, y, z, sq_radius;  // NaN in a lane without a query
  std::array<float, 3> min, max;
  float min_sq_radius, max_sq_radius;

  BasicQueryBlock(const SortedPoints& order, std::size_t block)
      : queries(order),
        begin(block * kSize),
        end(std::min(begin + kSize, order.size())),
        x(load_lanes<Lanes>(&order.x[begin])),
        y(load_lanes<Lanes>(&order.y[begin])),
        z(load_lanes<Lanes>(&order.z[begin])),
        sq_radius(load_lanes<Lanes>(&order.sq_radius[begin])) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      find_range(order.coordinate(axis), min[axis], max[axis]);
    }
    find_range(order.sq_radius, min_sq_radius, max_sq_radius);
  }

  /// How many blocks `queries` fill.
  static std::size_t count(const SortedPoints& queries) {
    return (queries.size() + kSize - 1) / kSize;
  }

 private:
  void find_range(const std::vector<float>& values, float& low, float& high) const {
    float min_value = values[begin], max_value = values[begin];  // in registers
    for (std::size_t i = begin + 1; i < end; ++i) {
      min_value = std::min(min_value, values[i]);
      max_value = std::max(max_value, values[i]);
    }
    low = min_value;
    high = max_value;
  }
};

using QueryBlock = BasicQueryBlock<FloatLanes>;

NVM_END_DETAIL_KERNELS

#endif  // NVM_NORMAL_QUERY_BLOCK_HPP
