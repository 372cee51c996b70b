// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>
#include <cstdint>

#include "nvm/map/storage/stored_normal.hpp"

namespace nvm::detail {

/// Sum n n^T over the stored normals of a surface: exact integers, so that neither the order of
/// insertion nor an erasure leaves a trace.
struct SurfaceMoments {
  std::int32_t xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(const StoredNormal& n) {
    xx += n.x * n.x;
    xy += n.x * n.y;
    xz += n.x * n.z;
    yy += n.y * n.y;
    yz += n.y * n.z;
    zz += n.z * n.z;
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

/// The unit vector along `v`; zero for zero.
inline StoredNormal store_direction(const WideVector& v) {
  const auto x = static_cast<float>(v.x);
  const auto y = static_cast<float>(v.y);
  const auto z = static_cast<float>(v.z);
  // Products of floats are exact in double, so that a fused multiply-add changes nothing.
  const double sq_length = double{x} * x + double{y} * y + double{z} * z;
  if (sq_length == 0.0) {
    return {};
  }
  const auto scale = static_cast<float>(1.0 / std::sqrt(sq_length));
  return {store_component(x * scale), store_component(y * scale), store_component(z * scale)};
}

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

/// True when `direction` is, up to its sign, the principal direction to about 2 degrees, more than
/// enough for a threshold of 90 +- 10: the matrix turns it by less than 1.3 degrees, and its
/// eigenvalue is more than half of the trace.
inline bool is_principal(const SurfaceMoments& m, const StoredNormal& direction) {
  // Keeps the products below 2^63; division, unlike a shift, treats both signs alike.
  constexpr std::int32_t kScale = 1 << 12;
  const std::int64_t x = (m.xx * direction.x + m.xy * direction.y + m.xz * direction.z) / kScale;
  const std::int64_t y = (m.xy * direction.x + m.yy * direction.y + m.yz * direction.z) / kScale;
  const std::int64_t z = (m.xz * direction.x + m.yz * direction.y + m.zz * direction.z) / kScale;
  const std::int64_t along = x * direction.x + y * direction.y + z * direction.z;
  const std::int64_t sq_direction = dot(direction, direction);
  const std::int64_t sq_across = sq_direction * (x * x + y * y + z * z) - along * along;
  const std::int64_t trace = m.xx + m.yy + m.zz;
  return sq_across < along * along / 2048 && 2 * along > trace * sq_direction / kScale;
}

/// The principal direction of a surface (spec §3.3): the dominant eigenvector of sum n n^T with the
/// sign of `sum`, sum n; zero without normals. In integers, because a fused multiply-add here would
/// make maps differ between processors.
inline StoredNormal principal_direction(const SurfaceMoments& moments, const WideVector& sum) {
  const WideMatrix matrix = matrix_of(moments);
  // Where the normals agree, as on any wall, one step of the power iteration from their sum is all
  // it takes, and keeps the sum's sign: the matrix is positive.
  const StoredNormal guess = store_direction(matrix * sum);
  if (is_principal(moments, guess)) {
    return guess;
  }
  const WideVector eigenvector = dominant_eigenvector(matrix);
  const std::int64_t sign = dot(eigenvector, sum) < 0 ? -1 : 1;
  return store_direction({sign * eigenvector.x, sign * eigenvector.y, sign * eigenvector.z});
}

}  // namespace nvm::detail
