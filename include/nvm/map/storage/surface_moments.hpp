// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>
#include <cstdint>

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

/// A symmetric 3 x 3 matrix and a vector of integers, for directions only: their scale does not
/// matter.
struct WideMatrix {
  std::int64_t xx, xy, xz, yy, yz, zz;
};
struct WideVector {
  std::int64_t x, y, z;
};

inline WideVector operator*(const WideMatrix& m, const WideVector& v) {
  return {
      m.xx * v.x + m.xy * v.y + m.xz * v.z,
      m.xy * v.x + m.yy * v.y + m.yz * v.z,
      m.xz * v.x + m.yz * v.y + m.zz * v.z};
}

inline std::int64_t dot(const WideVector& a, const WideVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The square of a positive semidefinite matrix, scaled by a power of two so that its entries stay
/// below 2^15.
inline WideMatrix scaled_square(const WideMatrix& m) {
  const WideMatrix square{
      m.xx * m.xx + m.xy * m.xy + m.xz * m.xz,
      m.xx * m.xy + m.xy * m.yy + m.xz * m.yz,
      m.xx * m.xz + m.xy * m.yz + m.xz * m.zz,
      m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
      m.xy * m.xz + m.yy * m.yz + m.yz * m.zz,
      m.xz * m.xz + m.yz * m.yz + m.zz * m.zz};
  // No entry is larger than the trace.
  const auto trace = static_cast<std::uint64_t>(square.xx + square.yy + square.zz);
  const int bits = 64 - __builtin_clzll(trace | 1U);
  const int shift = bits > 15 ? bits - 15 : 0;
  return {
      square.xx >> shift,
      square.xy >> shift,
      square.xz >> shift,
      square.yy >> shift,
      square.yz >> shift,
      square.zz >> shift};
}

inline StoredNormal store_direction(const WideVector& v) {
  const auto sq_length = static_cast<float>(dot(v, v));
  if (sq_length == 0.0F) {
    return {};
  }
  const float scale = 1.0F / std::sqrt(sq_length);
  const auto component = [scale](std::int64_t value) {
    return store_component(static_cast<float>(value) * scale);
  };
  return {component(v.x), component(v.y), component(v.z)};
}

/// True when the angle between two vectors is below 0.02 rad.
inline bool is_parallel(const WideVector& a, const WideVector& b) {
  constexpr double kSqTangent = 0.02 * 0.02;
  const WideVector cross{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  const auto along = static_cast<double>(dot(a, b));
  const auto sq = [](std::int64_t v) { return static_cast<double>(v) * static_cast<double>(v); };
  return sq(cross.x) + sq(cross.y) + sq(cross.z) < kSqTangent * along * along;
}

inline WideVector widened(const StoredNormal& n) { return {n.x, n.y, n.z}; }

/// The eigenvector of the largest eigenvalue of `m`, of either sign: a column of m^32, whose error
/// is the 32nd power of the ratio of the two largest eigenvalues.
inline WideVector dominant_eigenvector(WideMatrix m) {
  for (int squaring = 0; squaring < 5; ++squaring) {
    m = scaled_square(m);
  }
  if (m.xx >= m.yy && m.xx >= m.zz) {
    return {m.xx, m.xy, m.xz};
  }
  return m.yy >= m.zz ? WideVector{m.xy, m.yy, m.yz} : WideVector{m.xz, m.yz, m.zz};
}

inline WideMatrix matrix_of(const SurfaceMoments& moments) {
  return {moments.xx, moments.xy, moments.xz, moments.yy, moments.yz, moments.zz};
}

/// True when `direction` is the principal direction to about 2 degrees, more than enough for a
/// threshold of 90 +- 10: the matrix hardly turns it, its eigenvalue is more than half of the
/// trace, and it looks where the sum looks.
inline bool is_principal(const SurfaceMoments& moments, const StoredNormal& direction) {
  const WideMatrix m = matrix_of(moments);
  const WideVector v = widened(direction);
  const WideVector image = m * v;
  return is_parallel(v, image) && 2 * dot(v, image) > (m.xx + m.yy + m.zz) * dot(v, v) &&
         dot(v, {moments.x, moments.y, moments.z}) > 0;
}

/// The principal direction of a surface (spec §3.3): the dominant eigenvector of sum n n^T with the
/// sign of sum n; zero without normals. In integers, because a fused multiply-add here would make
/// maps differ between processors.
inline StoredNormal principal_direction(const SurfaceMoments& moments) {
  const WideVector sum{moments.x, moments.y, moments.z};
  // Where the normals agree, as on any wall, one step of the power iteration from their sum is all
  // it takes.
  const StoredNormal guess = store_direction(matrix_of(moments) * sum);
  if (is_principal(moments, guess)) {
    return guess;
  }
  const WideVector eigenvector = dominant_eigenvector(matrix_of(moments));
  const std::int64_t sign = dot(eigenvector, sum) < 0 ? -1 : 1;
  return store_direction({sign * eigenvector.x, sign * eigenvector.y, sign * eigenvector.z});
}

}  // namespace nvm::detail
