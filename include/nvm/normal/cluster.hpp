// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>

#include "nvm/core/target.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Number, mean and scatter of points that enter a neighbourhood together. Local coordinates [m].
struct Cluster {
  float count = 0.0F;
  float x = 0.0F, y = 0.0F, z = 0.0F;
  float xx = 0.0F, xy = 0.0F, xz = 0.0F, yy = 0.0F, yz = 0.0F, zz = 0.0F;
};

/// The `count` > 0 parts part(0), part(1), ... as one cluster. The mean is taken relative to the
/// first part, so that parts that coincide have exactly zero scatter.
template <class Part>
Cluster merge(std::size_t count, const Part& part) {
  const Cluster first = part(0);
  Cluster sum;
  for (std::size_t i = 0; i < count; ++i) {
    const Cluster& p = part(i);
    sum.count += p.count;
    sum.x += p.count * (p.x - first.x);
    sum.y += p.count * (p.y - first.y);
    sum.z += p.count * (p.z - first.z);
  }
  sum.x = first.x + sum.x / sum.count;
  sum.y = first.y + sum.y / sum.count;
  sum.z = first.z + sum.z / sum.count;
  for (std::size_t i = 0; i < count; ++i) {
    const Cluster& p = part(i);
    const float dx = p.x - sum.x, dy = p.y - sum.y, dz = p.z - sum.z;
    sum.xx += p.xx + p.count * dx * dx;
    sum.xy += p.xy + p.count * dx * dy;
    sum.xz += p.xz + p.count * dx * dz;
    sum.yy += p.yy + p.count * dy * dy;
    sum.yz += p.yz + p.count * dy * dz;
    sum.zz += p.zz + p.count * dz * dz;
  }
  return sum;
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
