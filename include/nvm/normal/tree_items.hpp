// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_NORMAL_TREE_ITEMS_HPP  // a kernel: nvm/core/target.hpp
#define NVM_NORMAL_TREE_ITEMS_HPP

#include <cstddef>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/normal/cluster.hpp"
#include "nvm/normal/lane_sums.hpp"
#include "nvm/normal/query_block.hpp"
#include "nvm/normal/sorted_points.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Where `point` is from the queries that have it within their radius; zero for the others.
inline Offset offset_within_radius(
    const SortedPoints& points, std::size_t point, const QueryBlock& query) {
  const FloatLanes dx = points.x[point] - query.x;
  const FloatLanes dy = points.y[point] - query.y;
  const FloatLanes dz = points.z[point] - query.z;
  const auto is_near = sq_length(dx, dy, dz) <= query.sq_radius;
  const FloatLanes zero{}, one = constant<FloatLanes>(1.0);
  return {is_near ? one : zero, is_near ? dx : zero, is_near ? dy : zero, is_near ? dz : zero};
}

/// What a BlockTree holds: the points of a scan.
struct PointItems {
  const SortedPoints& points;

  const SortedPoints& positions() const { return points; }
  Cluster cluster(std::size_t i) const { return {1.0F, points.x[i], points.y[i], points.z[i]}; }

  /// Adds item `i` to the sums of the queries that have it within their radius.
  void add_if_near(std::size_t i, const QueryBlock& query, Moments<FloatLanes>& sum) const {
    const Offset d = offset_within_radius(points, i, query);
    sum.add(d.weight, d.x, d.y, d.z);
  }
};

/// Or cells of a scan, each near where its mean is. There are as many clusters as padded means.
struct CellItems {
  const SortedPoints& means;
  const std::vector<Cluster>& cells;

  const SortedPoints& positions() const { return means; }
  const Cluster& cluster(std::size_t i) const { return cells[i]; }

  void add_if_near(std::size_t i, const QueryBlock& query, Moments<FloatLanes>& sum) const {
    add_cluster(cells[i], offset_within_radius(means, i, query), sum);
  }
};

NVM_END_DETAIL_KERNELS

#endif  // NVM_NORMAL_TREE_ITEMS_HPP
