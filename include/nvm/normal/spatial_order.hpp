// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "nvm/normal/local_points.hpp"
#include "nvm/normal/radix_sort.hpp"

namespace nvm::detail {

/// Points per block, and queries that are answered together.
inline constexpr std::size_t kBlockSize = 8;

/// Spreads the lowest 21 bits of `value` to every third bit.
inline std::uint64_t spread_bits(std::uint64_t value) {
  value = (value | value << 32) & 0x001f00000000ffffU;
  value = (value | value << 16) & 0x001f0000ff0000ffU;
  value = (value | value << 8) & 0x100f00f00f00f00fU;
  value = (value | value << 4) & 0x10c30c30c30c30c3U;
  return (value | value << 2) & 0x1249249249249249U;
}

/// The kept points of a cloud along a Morton (Z-order) curve: points that follow each other lie
/// near each other. `index` tells where each stood in the cloud. The arrays end with NaN up to a
/// multiple of kBlockSize: such a lane is no one's neighbour and has none.
class SpatialOrder {
 public:
  std::vector<float> x, y, z, sq_radius;
  std::vector<std::uint32_t> index;

  std::size_t size() const { return index.size(); }
  std::size_t block_count() const { return (size() + kBlockSize - 1) / kBlockSize; }

  /// Sorts the points whose status is kValid by cubes of edge `resolution` [m], in input order
  /// within a cube. The cubes are coarser where 21 bits per axis do not reach: slower, never wrong.
  void sort(const LocalPoints& points, const std::vector<NormalStatus>& status, double resolution) {
    keep_valid(status);
    const Lattice lattice = lattice_over(points, resolution);
    for (KeyedIndex& item : order_) {
      item.key = lattice.key(points.x[item.index], points.y[item.index], points.z[item.index]);
    }
    radix_sort(order_, scratch_, 3 * lattice.axis_bits);
    gather(points);
  }

 private:
  struct Lattice {
    float min_x, min_y, min_z, per_meter;
    int axis_bits;

    std::uint64_t key(float px, float py, float pz) const {
      return spread_bits(cell(px - min_x)) << 2 | spread_bits(cell(py - min_y)) << 1 |
             spread_bits(cell(pz - min_z));
    }
    std::uint64_t cell(float offset) const {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(offset * per_meter));
    }
  };

  void keep_valid(const std::vector<NormalStatus>& status) {
    order_.clear();
    for (std::size_t i = 0; i < status.size(); ++i) {
      if (status[i] == NormalStatus::kValid) {
        order_.push_back({0, static_cast<std::uint32_t>(i)});
      }
    }
  }

  Lattice lattice_over(const LocalPoints& points, double resolution) const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::array<float, 3> min{kInfinity, kInfinity, kInfinity};
    std::array<float, 3> max{-kInfinity, -kInfinity, -kInfinity};
    for (const KeyedIndex& item : order_) {
      const float p[3] = {points.x[item.index], points.y[item.index], points.z[item.index]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        min[axis] = std::min(min[axis], p[axis]);
        max[axis] = std::max(max[axis], p[axis]);
      }
    }
    const float extent = std::max({max[0] - min[0], max[1] - min[1], max[2] - min[2], 0.0F});
    constexpr double kMaxCells = 1 << 20;  // half of 21 bits: room for rounding
    const double edge = std::max(resolution, extent / kMaxCells);
    const int axis_bits = std::ilogb(extent / edge + 1.0) + 1;
    return {min[0], min[1], min[2], static_cast<float>(1.0 / edge), axis_bits};
  }

  void gather(const LocalPoints& points) {
    index.resize(order_.size());
    const std::size_t padded = block_count() * kBlockSize;
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (std::vector<float>* values : {&x, &y, &z, &sq_radius}) {
      values->resize(padded);
      std::fill(values->begin() + static_cast<std::ptrdiff_t>(size()), values->end(), kNaN);
    }
    for (std::size_t i = 0; i < size(); ++i) {
      const std::uint32_t from = order_[i].index;
      index[i] = from;
      x[i] = points.x[from];
      y[i] = points.y[from];
      z[i] = points.z[from];
      sq_radius[i] = points.sq_radius[from];
    }
  }

  std::vector<KeyedIndex> order_, scratch_;
};

}  // namespace nvm::detail
