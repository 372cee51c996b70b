// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_NORMAL_LANE_SUMS_HPP  // a kernel: nvm/core/target.hpp
#define NVM_NORMAL_LANE_SUMS_HPP

#include "nvm/core/target.hpp"
#include "nvm/geometry/float_lanes.hpp"
#include "nvm/geometry/moments.hpp"
#include "nvm/normal/cluster.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Where something is from each query, and whether it counts there: the weight is one or zero.
struct Offset {
  FloatLanes weight, x, y, z;
};

/// Adds a cluster whose mean lies at `d` from the query.
inline void add_cluster(const Cluster& cluster, const Offset& d, Moments<FloatLanes>& sum) {
  const FloatLanes count = cluster.count * d.weight;
  const FloatLanes x = count * d.x, y = count * d.y, z = count * d.z;
  sum.count += count;
  sum.x += x;
  sum.y += y;
  sum.z += z;
  sum.xx += cluster.xx * d.weight + x * d.x;
  sum.xy += cluster.xy * d.weight + x * d.y;
  sum.xz += cluster.xz * d.weight + x * d.z;
  sum.yy += cluster.yy * d.weight + y * d.y;
  sum.yz += cluster.yz * d.weight + y * d.z;
  sum.zz += cluster.zz * d.weight + z * d.z;
}

NVM_END_DETAIL_KERNELS

#endif  // NVM_NORMAL_LANE_SUMS_HPP
