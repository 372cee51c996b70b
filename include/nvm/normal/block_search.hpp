// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "nvm/normal/block_tree.hpp"
#include "nvm/normal/query_block.hpp"

namespace nvm::detail {

/// Sums the neighbourhoods of a block of queries over a BlockTree.
///
/// A node whose box lies within the radius of every query enters with its moments, which is exact
/// up to rounding and bounds the work among dense points; a node out of reach of all is skipped;
/// what is left, blocks of points at the rim, is tested pair by pair, a query per lane. Reads only;
/// safe from many threads.
class BlockSearch {
 public:
  BlockSearch(const SpatialOrder& points, const BlockTree& tree) : points_(points), tree_(tree) {}

  void operator()(const QueryBlock& query, BlockMoments& sums) const {
    if (tree_.leaf_count() == 0) {
      return;
    }
    NodeList groups, inside, rim;
    groups.push(tree_.root_group());
    while (groups.size > 0) {
      const std::uint32_t group = groups.items[--groups.size];
      const Reach reach = classify(query, group);
      NodeList& reached = group * BlockTree::kFanout < tree_.leaf_count() ? rim : groups;
      for (std::uint32_t i = 0; i < BlockTree::kFanout; ++i) {
        const std::uint32_t node = group * BlockTree::kFanout + i;
        inside.push_if(reach.is_inside[i], node);
        reached.push_if(reach.is_rim[i], tree_.below[node]);
      }
      flush_if_full(query, inside, rim, sums);
    }
    add_nodes(query, inside, sums);
    add_blocks(query, rim, sums);
  }

 private:
  // Depth first, a group of eight for one: at most 7 per level and 11 levels for 2^32 points.
  struct NodeList {
    static constexpr std::size_t kCapacity = 128;
    std::array<std::uint32_t, kCapacity> items;
    std::size_t size = 0;

    void push(std::uint32_t item) { items[size++] = item; }
    void push_if(std::int32_t condition, std::uint32_t item) {  // without a branch
      items[size] = item;
      size += static_cast<std::size_t>(condition & 1);
    }
    bool is_full() const { return size + BlockTree::kFanout >= kCapacity; }
  };

  struct Reach {
    std::int32_t is_inside[BlockTree::kFanout];
    std::int32_t is_rim[BlockTree::kFanout];
  };

  // The margins cover the rounding of the two ways to compute a distance.
  Reach classify(const QueryBlock& query, std::uint32_t group) const {
    constexpr float kMargin = 1e-6F;
    const float sq_inside = query.min_sq_radius * (1.0F - kMargin);
    const float sq_reach = query.max_sq_radius * (1.0F + kMargin);
    Reach reach;
    for (std::size_t i = 0; i < BlockTree::kFanout; i += kLaneCount) {
      const std::size_t node = std::size_t{group} * BlockTree::kFanout + i;
      const auto above_x = query.max_x - load_lanes(&tree_.min_x[node]);
      const auto above_y = query.max_y - load_lanes(&tree_.min_y[node]);
      const auto above_z = query.max_z - load_lanes(&tree_.min_z[node]);
      const auto below_x = load_lanes(&tree_.max_x[node]) - query.min_x;
      const auto below_y = load_lanes(&tree_.max_y[node]) - query.min_y;
      const auto below_z = load_lanes(&tree_.max_z[node]) - query.min_z;
      const FloatLaneBits is_inside =
          sq_length(larger(above_x, below_x), larger(above_y, below_y), larger(above_z, below_z)) <=
          sq_inside;
      const FloatLaneBits is_near =
          sq_length(gap(above_x, below_x), gap(above_y, below_y), gap(above_z, below_z)) <=
          sq_reach;
      const FloatLaneBits is_rim = is_near & ~is_inside;
      std::memcpy(&reach.is_inside[i], &is_inside, sizeof(is_inside));
      std::memcpy(&reach.is_rim[i], &is_rim, sizeof(is_rim));
    }
    return reach;
  }

  // Distance between two intervals [a, b] and [c, d] from b - c and d - a: one is negative when
  // they are apart.
  static FloatLanes gap(const FloatLanes& above, const FloatLanes& below) {
    return smaller(smaller(above, below), FloatLanes{});
  }

  void flush_if_full(
      const QueryBlock& query, NodeList& inside, NodeList& rim, BlockMoments& sums) const {
    if (inside.is_full()) {
      add_nodes(query, inside, sums);
    }
    if (rim.is_full()) {
      add_blocks(query, rim, sums);
    }
  }

  void add_nodes(const QueryBlock& query, NodeList& nodes, BlockMoments& sums) const {
    for (std::size_t group = 0; group < kLaneGroups; ++group) {
      const FloatLanes x = load_lanes(query.x + group * kLaneCount);
      const FloatLanes y = load_lanes(query.y + group * kLaneCount);
      const FloatLanes z = load_lanes(query.z + group * kLaneCount);
      Moments<FloatLanes> sum = sums[group];
      for (std::size_t i = 0; i < nodes.size; ++i) {
        add_node(tree_.moments[nodes.items[i]], x, y, z, sum);
      }
      sums[group] = sum;
    }
    nodes.size = 0;
  }

  static void add_node(
      const NodeMoments& node,
      const FloatLanes& x,
      const FloatLanes& y,
      const FloatLanes& z,
      Moments<FloatLanes>& sum) {
    const FloatLanes dx = node.x - x, dy = node.y - y, dz = node.z - z;
    const FloatLanes nx = node.count * dx, ny = node.count * dy, nz = node.count * dz;
    sum.count += node.count;
    sum.x += nx;
    sum.y += ny;
    sum.z += nz;
    sum.xx += node.xx + nx * dx;
    sum.xy += node.xy + nx * dy;
    sum.xz += node.xz + nx * dz;
    sum.yy += node.yy + ny * dy;
    sum.yz += node.yz + ny * dz;
    sum.zz += node.zz + nz * dz;
  }

  void add_blocks(const QueryBlock& query, NodeList& blocks, BlockMoments& sums) const {
    for (std::size_t group = 0; group < kLaneGroups; ++group) {
      const FloatLanes x = load_lanes(query.x + group * kLaneCount);
      const FloatLanes y = load_lanes(query.y + group * kLaneCount);
      const FloatLanes z = load_lanes(query.z + group * kLaneCount);
      const FloatLanes sq_radius = load_lanes(query.sq_radius + group * kLaneCount);
      Moments<FloatLanes> sum = sums[group];
      for (std::size_t i = 0; i < blocks.size; ++i) {
        const std::size_t begin = std::size_t{blocks.items[i]} * kBlockSize;
        for (std::size_t j = begin; j < begin + kBlockSize; ++j) {
          const FloatLanes dx = points_.x[j] - x, dy = points_.y[j] - y, dz = points_.z[j] - z;
          const auto is_neighbor = sq_length(dx, dy, dz) <= sq_radius;
          const FloatLanes zero{}, one = constant<FloatLanes>(1.0);
          sum.add(
              is_neighbor ? one : zero,
              is_neighbor ? dx : zero,
              is_neighbor ? dy : zero,
              is_neighbor ? dz : zero);
        }
      }
      sums[group] = sum;
    }
    blocks.size = 0;
  }

  const SpatialOrder& points_;
  const BlockTree& tree_;
};

}  // namespace nvm::detail
