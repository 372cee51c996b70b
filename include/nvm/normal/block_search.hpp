// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_NORMAL_BLOCK_SEARCH_HPP  // a kernel: nvm/core/target.hpp
#define NVM_NORMAL_BLOCK_SEARCH_HPP

#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/normal/block_tree.hpp"
#include "nvm/normal/node_list.hpp"
#include "nvm/normal/query_block.hpp"
#include "nvm/normal/tree_items.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Sums the neighbourhoods of a block of queries over a BlockTree.
///
/// A node whose box lies within the radius of every query enters as one cluster, which is exact up
/// to rounding and bounds the work among dense points; a node out of reach of all is skipped; what
/// is left, leaves at the rim, is tested item by item, a query per lane. Reads only; safe from many
/// threads.
template <class Items>
class BlockSearch {
 public:
  BlockSearch(const Items& items, const BlockTree& tree) : items_(items), tree_(tree) {}

  void operator()(const QueryBlock& query, Moments<FloatLanes>& sums) const {
    if (tree_.empty()) {
      return;
    }
    // Depth first, a group of eight for one: at most 7 groups for each of the 11 levels wait.
    NodeList groups, inside, rim;
    groups.push(tree_.root_group());
    while (!groups.empty()) {
      const std::uint32_t group = groups.pop();
      const std::uint32_t first_node = group * BlockTree::kFanout;
      const Reach reach = classify(query, first_node);
      inside.append(first_node, reach.inside);
      if (tree_.is_leaf_group(group)) {
        rim.append(first_node, reach.rim);
      } else {
        groups.append(tree_.first_below[group], reach.rim);
      }
      if (inside.is_full() || rim.is_full()) {
        add(query, inside, rim, sums);
      }
    }
    add(query, inside, rim, sums);
  }

 private:
  // Bit i of each: the box of node i of a group lies within the radius of all queries; it does not,
  // but may have items within the radius of some.
  struct Reach {
    std::uint32_t inside = 0;
    std::uint32_t rim = 0;
  };

  Reach classify(const QueryBlock& query, std::size_t first_node) const {
    constexpr float kMargin = 1e-6F;  // for the rounding of the two ways to compute a distance
    const float sq_inside = query.min_sq_radius * (1.0F - kMargin);
    const float sq_reach = query.max_sq_radius * (1.0F + kMargin);
    Reach reach;
    for (std::size_t i = 0; i < BlockTree::kFanout; i += kLaneCount) {
      FloatLanes farthest[3], gap[3];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const FloatLanes above = query.max[axis] - load_lanes(&tree_.min[axis][first_node + i]);
        const FloatLanes below = load_lanes(&tree_.max[axis][first_node + i]) - query.min[axis];
        farthest[axis] = larger(above, below);
        gap[axis] = smaller(smaller(above, below), FloatLanes{});  // negative when apart
      }
      const std::uint32_t inside =
          lane_bits(sq_length(farthest[0], farthest[1], farthest[2]) <= sq_inside);
      const std::uint32_t near = lane_bits(sq_length(gap[0], gap[1], gap[2]) <= sq_reach);
      reach.inside |= inside << i;
      reach.rim |= (near & ~inside) << i;
    }
    return reach;
  }

  // Adds what the lists hold to the sums, and empties the lists.
  void add(
      const QueryBlock& query, NodeList& inside, NodeList& rim, Moments<FloatLanes>& sums) const {
    const auto one = constant<FloatLanes>(1.0);
    Moments<FloatLanes> sum = sums;  // in registers
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const Cluster& c = tree_.clusters[inside[i]];
      add_cluster(c, {one, c.x - query.x, c.y - query.y, c.z - query.z}, sum);
    }
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::size_t first = std::size_t{rim[i]} * BlockTree::kLeafSize;
      for (std::size_t j = 0; j < BlockTree::kLeafSize; ++j) {
        items_.add_if_near(first + j, query, sum);
      }
    }
    sums = sum;
    inside.clear();
    rim.clear();
  }

  Items items_;
  const BlockTree& tree_;
};

NVM_END_DETAIL_KERNELS

#endif  // NVM_NORMAL_BLOCK_SEARCH_HPP
