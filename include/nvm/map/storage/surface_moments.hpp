// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "nvm/map/storage/stored_normal.hpp"

namespace nvm::detail {

/// Sum n and sum n n^T over the stored normals of a surface: exact integers, so that neither the
/// order of insertion nor an erasure leaves a trace.
struct SurfaceMoments {
  std::int32_t xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  std::int16_t x = 0, y = 0, z = 0;

  void add(const StoredNormal& n) {
    xx += n.x * n.x;
    xy += n.x * n.y;
    xz += n.x * n.z;
    yy += n.y * n.y;
    yz += n.y * n.z;
    zz += n.z * n.z;
    x = static_cast<std::int16_t>(x + n.x);
    y = static_cast<std::int16_t>(y + n.y);
    z = static_cast<std::int16_t>(z + n.z);
  }
};

struct WideVector {
  std::int64_t x, y, z;
};

/// `v` scaled down by a power of two to components below 2^15.
inline WideVector narrowed(const WideVector& v) {
  const auto magnitude =
      static_cast<std::uint64_t>(std::llabs(v.x) | std::llabs(v.y) | std::llabs(v.z));
  const int bits = magnitude == 0 ? 0 : 64 - __builtin_clzll(magnitude);
  const int shift = bits > 15 ? bits - 15 : 0;
  return {v.x >> shift, v.y >> shift, v.z >> shift};
}

inline WideVector times(const SurfaceMoments& m, const WideVector& v) {
  return {
      m.xx * v.x + m.xy * v.y + m.xz * v.z,
      m.xy * v.x + m.yy * v.y + m.yz * v.z,
      m.xz * v.x + m.yz * v.y + m.zz * v.z};
}

inline StoredNormal store_direction(const WideVector& v) {
  const double length = std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z));
  if (length == 0.0) {
    return {};
  }
  const auto component = [length](std::int64_t value) {
    return static_cast<std::int8_t>(
        std::nearbyint(static_cast<double>(value * kNormalScale) / length));
  };
  return {component(v.x), component(v.y), component(v.z)};
}

/// The principal direction of a surface (spec §3.3): the dominant eigenvector of sum n n^T with the
/// sign of sum n; zero without normals.
///
/// Power iteration from sum n, which already lies near that eigenvector. Four steps leave
/// (lambda2/lambda1)^4 of the distance, within the resolution of StoredNormal for any surface whose
/// normals scatter by less than 45 degrees. In integers, because a fused multiply-add here would
/// make maps differ between processors.
inline StoredNormal principal_direction(const SurfaceMoments& m) {
  constexpr int kSteps = 4;
  WideVector v{m.x, m.y, m.z};
  for (int step = 0; step < kSteps; ++step) {
    v = narrowed(times(m, v));
  }
  return store_direction(v);
}

}  // namespace nvm::detail
