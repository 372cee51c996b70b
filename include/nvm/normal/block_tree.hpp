// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "nvm/normal/spatial_order.hpp"

namespace nvm::detail {

/// Number, mean and scatter of the points below a node.
struct NodeMoments {
  float count = 0.0F;
  float x = 0.0F, y = 0.0F, z = 0.0F;
  float xx = 0.0F, xy = 0.0F, xz = 0.0F, yy = 0.0F, yz = 0.0F, zz = 0.0F;

  void add_scatter(float weight, float dx, float dy, float dz) {
    xx += weight * dx * dx;
    xy += weight * dx * dy;
    xz += weight * dx * dz;
    yy += weight * dy * dy;
    yz += weight * dy * dz;
    zz += weight * dz * dz;
  }
};

/// A hierarchy of bounding boxes over points in spatial order. Leaf i bounds the block of points
/// [8 i, 8 i + 8); every node above bounds a group of eight nodes of the level below. A level is
/// stored as whole groups, padded with empty boxes; the leaves come first, the root group last.
class BlockTree {
 public:
  static constexpr std::uint32_t kFanout = kBlockSize;

  // Bounds of the nodes [m], structure of arrays, local coordinates.
  std::vector<float> min_x, min_y, min_z, max_x, max_y, max_z;
  std::vector<NodeMoments> moments;
  /// The group of eight nodes below a node; for a leaf, its block.
  std::vector<std::uint32_t> below;

  std::uint32_t leaf_count() const { return leaf_count_; }
  std::uint32_t root_group() const {
    return static_cast<std::uint32_t>(below.size()) / kFanout - 1;
  }

  template <class Executor>
  void build(const SpatialOrder& points, const Executor& executor) {
    constexpr std::size_t kGrain = 128;
    clear();
    leaf_count_ = static_cast<std::uint32_t>(points.block_count());
    std::uint32_t first = append_level(leaf_count_, 0);
    executor.for_blocks(leaf_count_, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t leaf = begin; leaf < end; ++leaf) {
        bound_points(points, leaf);
      }
    });
    while (below.size() - first > kFanout) {
      const std::uint32_t first_group = first / kFanout;
      const auto groups = static_cast<std::uint32_t>(below.size()) / kFanout - first_group;
      first = append_level(groups, first_group);
      for (std::uint32_t node = first; node < first + groups; ++node) {
        bound_group(node);
      }
    }
  }

 private:
  void clear() {
    for (std::vector<float>* bound : {&min_x, &min_y, &min_z, &max_x, &max_y, &max_z}) {
      bound->clear();
    }
    moments.clear();
    below.clear();
  }

  // Appends `count` empty nodes over the groups that start at `first_below`; returns the first.
  std::uint32_t append_level(std::uint32_t count, std::uint32_t first_below) {
    const auto first = static_cast<std::uint32_t>(below.size());
    const std::size_t size = first + (count + kFanout - 1) / kFanout * kFanout;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (std::vector<float>* bound : {&min_x, &min_y, &min_z}) {
      bound->resize(size, kInfinity);
    }
    for (std::vector<float>* bound : {&max_x, &max_y, &max_z}) {
      bound->resize(size, -kInfinity);
    }
    moments.resize(size);
    for (std::size_t node = first; node < size; ++node) {
      below.push_back(first_below + static_cast<std::uint32_t>(node) - first);
    }
    return first;
  }

  void bound_points(const SpatialOrder& points, std::size_t leaf) {
    const std::size_t begin = leaf * kBlockSize;
    const std::size_t end = std::min(begin + kBlockSize, points.size());
    for (std::size_t i = begin; i < end; ++i) {
      extend(leaf, points.x[i], points.y[i], points.z[i], points.x[i], points.y[i], points.z[i]);
    }
    const NodeMoments first{1.0F, points.x[begin], points.y[begin], points.z[begin]};
    NodeMoments& sum = moments[leaf];
    sum = mean_from(first, end - begin, [&](std::size_t i) {
      return NodeMoments{1.0F, points.x[begin + i], points.y[begin + i], points.z[begin + i]};
    });
  }

  void bound_group(std::uint32_t node) {
    const std::size_t begin = std::size_t{below[node]} * kFanout;
    for (std::size_t i = begin; i < begin + kFanout; ++i) {
      extend(node, min_x[i], min_y[i], min_z[i], max_x[i], max_y[i], max_z[i]);
    }
    moments[node] = mean_from(moments[begin], kFanout, [&](std::size_t i) -> const NodeMoments& {
      return moments[begin + i];
    });
  }

  void extend(
      std::size_t node,
      float low_x,
      float low_y,
      float low_z,
      float high_x,
      float high_y,
      float high_z) {
    min_x[node] = std::min(min_x[node], low_x);
    min_y[node] = std::min(min_y[node], low_y);
    min_z[node] = std::min(min_z[node], low_z);
    max_x[node] = std::max(max_x[node], high_x);
    max_y[node] = std::max(max_y[node], high_y);
    max_z[node] = std::max(max_z[node], high_z);
  }

  // The moments of `count` parts together. The mean is taken relative to the first part, so that
  // parts that coincide have exactly zero scatter.
  template <class Part>
  static NodeMoments mean_from(const NodeMoments& first, std::size_t count, const Part& part) {
    NodeMoments sum;
    for (std::size_t i = 0; i < count; ++i) {
      const NodeMoments& p = part(i);
      sum.count += p.count;
      sum.x += p.count * (p.x - first.x);
      sum.y += p.count * (p.y - first.y);
      sum.z += p.count * (p.z - first.z);
    }
    sum.x = first.x + sum.x / sum.count;
    sum.y = first.y + sum.y / sum.count;
    sum.z = first.z + sum.z / sum.count;
    for (std::size_t i = 0; i < count; ++i) {
      const NodeMoments& p = part(i);
      sum.xx += p.xx;
      sum.xy += p.xy;
      sum.xz += p.xz;
      sum.yy += p.yy;
      sum.yz += p.yz;
      sum.zz += p.zz;
      sum.add_scatter(p.count, p.x - sum.x, p.y - sum.y, p.z - sum.z);
    }
    return sum;
  }

  std::uint32_t leaf_count_ = 0;
};

}  // namespace nvm::detail
