// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/normal/cluster.hpp"
#include "nvm/normal/sorted_points.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// A hierarchy of bounding boxes over items in spatial order. Leaf i bounds the items
/// [4 i, 4 i + 4); every node above bounds a group of eight nodes of the level below. A level is
/// stored as whole groups, padded with empty boxes; the leaves come first, the root group last.
class BlockTree {
 public:
  static constexpr std::size_t kLeafSize = 4;
  static constexpr std::uint32_t kFanout = 8;
  static_assert(SortedPoints::kPadding % kLeafSize == 0, "leaves end in padding");

  // Of the nodes: bounds [m] as a structure of arrays, and what is below them as one cluster.
  std::array<std::vector<float>, 3> min, max;
  std::vector<Cluster> clusters;

  /// Of a group above the leaves: the group below its first node; those of the next nodes follow.
  std::vector<std::uint32_t> first_below;

  bool empty() const { return leaf_groups_ == 0; }
  bool is_leaf_group(std::uint32_t group) const { return group < leaf_groups_; }
  std::uint32_t root_group() const { return group_count() - 1; }

  /// `items`: see tree_items.hpp.
  template <class Items, class Executor>
  void build(const Items& items, const Executor& executor) {
    constexpr std::size_t kGrain = 256;
    clear();
    const std::size_t leaves = (items.positions().size() + kLeafSize - 1) / kLeafSize;
    append_level(static_cast<std::uint32_t>(leaves));
    leaf_groups_ = group_count();
    executor.for_blocks(leaves, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t leaf = begin; leaf < end; ++leaf) {
        bound_items(items, leaf);
      }
    });
    for (std::uint32_t first = 0; group_count() > first + 1;) {
      first = add_level_above(first);
    }
  }

 private:
  std::uint32_t group_count() const { return static_cast<std::uint32_t>(first_below.size()); }

  template <class = void>
  void clear() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis].clear();
      max[axis].clear();
    }
    clusters.clear();
    first_below.clear();
  }

  // Appends whole groups of empty nodes, `nodes` at least.
  template <class = void>
  void append_level(std::uint32_t nodes) {
    const std::size_t groups = group_count() + (nodes + kFanout - 1) / kFanout;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis].resize(groups * kFanout, kInfinity);
      max[axis].resize(groups * kFanout, -kInfinity);
    }
    clusters.resize(groups * kFanout);
    first_below.resize(groups);
  }

  // Bounds the groups from `first` on; returns the first group of the new level.
  template <class = void>
  std::uint32_t add_level_above(std::uint32_t first) {
    const std::uint32_t level = group_count();
    append_level(level - first);
    for (std::uint32_t group = first; group < level; ++group) {
      bound_group(group, level * kFanout + group - first);
    }
    for (std::uint32_t group = level; group < group_count(); ++group) {
      first_below[group] = first + (group - level) * kFanout;
    }
    return level;
  }

  template <class Items>
  void bound_items(const Items& items, std::size_t leaf) {
    const std::size_t begin = leaf * kLeafSize;
    const std::size_t size = std::min(kLeafSize, items.positions().size() - begin);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* first = &items.positions().coordinate(axis)[begin];
      min[axis][leaf] = *std::min_element(first, first + size);
      max[axis][leaf] = *std::max_element(first, first + size);
    }
    clusters[leaf] = merge(size, [&](std::size_t i) { return items.cluster(begin + i); });
  }

  template <class = void>
  void bound_group(std::uint32_t group, std::uint32_t node) {
    const std::size_t begin = std::size_t{group} * kFanout;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis][node] = *std::min_element(&min[axis][begin], &min[axis][begin] + kFanout);
      max[axis][node] = *std::max_element(&max[axis][begin], &max[axis][begin] + kFanout);
    }
    clusters[node] = merge(kFanout, [&](std::size_t i) { return clusters[begin + i]; });
  }

  std::uint32_t leaf_groups_ = 0;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
