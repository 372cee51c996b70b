// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/normal/local_points.hpp"
#include "nvm/normal/radix_sort.hpp"
#include "nvm/normal/sorted_points.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Spreads the lowest 21 bits of `value` to every third bit.
inline std::uint64_t spread_bits(std::uint64_t value) {
  value = (value | value << 32) & 0x001f00000000ffffU;
  value = (value | value << 16) & 0x001f0000ff0000ffU;
  value = (value | value << 8) & 0x100f00f00f00f00fU;
  value = (value | value << 4) & 0x10c30c30c30c30c3U;
  return (value | value << 2) & 0x1249249249249249U;
}

/// The rank of `code` in the order in which neighbouring codes differ in one bit.
inline std::uint64_t gray_rank(std::uint64_t code) {
  for (const int shift : {1, 2, 4, 8, 16, 32}) {
    code ^= code >> shift;
  }
  return code;
}

/// Sorts points into a grid of cubes and the cubes along a Morton curve in Gray-code order, which
/// jumps less than the plain one.
class SpatialSorter {
 public:
  /// The points whose status is kValid, by cubes of edge `edge` [m], in input order within a cube.
  /// Where 21 bits per axis do not reach, the cubes are coarser: slower, never wrong.
  template <class = void>
  void sort(
      const LocalPoints& points,
      const std::vector<NormalStatus>& status,
      double edge,
      SortedPoints& sorted) {
    keep_valid(status);
    const Lattice lattice = lattice_over(points, edge);
    for (KeyedIndex& item : order_) {
      item.key = lattice.key(points.x[item.index], points.y[item.index], points.z[item.index]);
    }
    radix_sort(order_, scratch_, 3 * lattice.axis_bits);
    gather(points, sorted);
  }

  /// Calls visit(begin, end) for each cube of the last sort: the range of its points.
  template <class Visitor>
  void for_each_cube(const Visitor& visit) const {
    for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
      while (end < order_.size() && order_[end].key == order_[begin].key) {
        ++end;
      }
      visit(begin, end);
    }
  }

 private:
  struct Lattice {
    float min_x, min_y, min_z, per_meter;
    int axis_bits;

    std::uint64_t key(float x, float y, float z) const {
      return gray_rank(
          spread_bits(cell(x - min_x)) << 2 | spread_bits(cell(y - min_y)) << 1 |
          spread_bits(cell(z - min_z)));
    }
    std::uint64_t cell(float offset) const {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(offset * per_meter));
    }
  };

  template <class = void>
  void keep_valid(const std::vector<NormalStatus>& status) {
    order_.resize(status.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < status.size(); ++i) {
      order_[kept].index = static_cast<std::uint32_t>(i);
      kept += status[i] == NormalStatus::kValid ? 1U : 0U;
    }
    order_.resize(kept);
  }

  template <class = void>
  Lattice lattice_over(const LocalPoints& points, double edge) const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    float min[3] = {kInfinity, kInfinity, kInfinity};
    float extent = 0.0F;
    const std::vector<float>* coordinates[3] = {&points.x, &points.y, &points.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float max = -kInfinity;
      for (const KeyedIndex& item : order_) {
        const float value = (*coordinates[axis])[item.index];
        min[axis] = std::min(min[axis], value);
        max = std::max(max, value);
      }
      extent = std::max(extent, max - min[axis]);
    }
    constexpr double kMaxCells = 1 << 20;  // half of 21 bits: room for rounding
    const double cube = std::max(edge, extent / kMaxCells);
    return {
        min[0],
        min[1],
        min[2],
        static_cast<float>(1.0 / cube),
        std::ilogb(extent / cube + 1.0) + 1};
  }

  template <class = void>
  void gather(const LocalPoints& points, SortedPoints& sorted) const {
    sorted.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const std::uint32_t from = order_[i].index;
      sorted.index[i] = from;
      sorted.x[i] = points.x[from];
      sorted.y[i] = points.y[from];
      sorted.z[i] = points.z[from];
      sorted.sq_radius[i] = points.sq_radius[from];
    }
  }

  std::vector<KeyedIndex> order_, scratch_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
