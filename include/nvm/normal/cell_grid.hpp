// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/geometry/moments.hpp"
#include "nvm/normal/cluster.hpp"
#include "nvm/normal/sorted_points.hpp"
#include "nvm/normal/spatial_sorter.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// The points of a scan summed up in cubic cells, for NormalMethod::kPerCell.
class CellGrid {
 public:
  /// The means of the cells; `index` numbers the cells.
  const SortedPoints& means() const { return means_; }
  /// Padded like the means.
  const std::vector<Cluster>& cells() const { return cells_; }
  std::size_t size() const { return means_.size(); }

  /// Builds a cell of each cube that `sorter` made of `points`. A cell reaches as far as its first
  /// point, `min_radius` [m] at least.
  template <class = void>
  void build(const SortedPoints& points, const SpatialSorter& sorter, double min_radius) {
    cells_.clear();
    begin_.clear();
    sorter.for_each_cube([&](std::size_t begin, std::size_t end) {
      begin_.push_back(static_cast<std::uint32_t>(begin));
      cells_.push_back(cluster_of(points, begin, end));
    });
    begin_.push_back(static_cast<std::uint32_t>(points.size()));

    const auto min_sq_radius = static_cast<float>(min_radius * min_radius);
    means_.resize(cells_.size());
    for (std::size_t i = 0; i < size(); ++i) {
      means_.x[i] = cells_[i].x;
      means_.y[i] = cells_[i].y;
      means_.z[i] = cells_[i].z;
      means_.sq_radius[i] = std::max(points.sq_radius[begin_[i]], min_sq_radius);
      means_.index[i] = static_cast<std::uint32_t>(i);
    }
    cells_.resize(means_.x.size());
  }

  /// Calls visit(cell, point) for every point of every cell; `point` as numbered in the scan.
  template <class Visitor>
  void for_each_point(const SortedPoints& points, const Visitor& visit) const {
    for (std::size_t cell = 0; cell < size(); ++cell) {
      for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; ++i) {
        visit(cell, points.index[i]);
      }
    }
  }

 private:
  static Cluster cluster_of(const SortedPoints& p, std::size_t begin, std::size_t end) {
    Moments<float> m;
    for (std::size_t i = begin; i < end; ++i) {
      m.add(1.0F, p.x[i] - p.x[begin], p.y[i] - p.y[begin], p.z[i] - p.z[begin]);
    }
    const Symmetric3<float> s = scatter(m);
    const float share = 1.0F / m.count;
    return {
        m.count,
        p.x[begin] + share * m.x,
        p.y[begin] + share * m.y,
        p.z[begin] + share * m.z,
        s.xx,
        s.xy,
        s.xz,
        s.yy,
        s.yz,
        s.zz};
  }

  SortedPoints means_;
  std::vector<Cluster> cells_;
  std::vector<std::uint32_t> begin_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
