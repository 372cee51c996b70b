// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/stored_normal.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

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

inline WideVector cross(const WideVector& a, const WideVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline WideVector wide(const StoredNormal& n) { return {n.x, n.y, n.z}; }

/// What the principal direction of a surface is made of: exact integers, so that the order of
/// insertion leaves no trace.
struct NormalSums {
  WideVector normals{0, 0, 0};           // sum n
  WideMatrix squares{0, 0, 0, 0, 0, 0};  // sum n n^T
  int count = 0;

  /// Sightings are no normals.
  void add(const StoredNormal& stored) {
    if (is_sighting(stored)) {
      return;
    }
    const WideVector n = wide(stored);
    normals = {normals.x + n.x, normals.y + n.y, normals.z + n.z};
    squares.xx += n.x * n.x;
    squares.xy += n.x * n.y;
    squares.xz += n.x * n.z;
    squares.yy += n.y * n.y;
    squares.yz += n.y * n.z;
    squares.zz += n.z * n.z;
    ++count;
  }
};

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

/// (sum n n^T) d for the principal direction d of a surface: one step of the power iteration. Kept
/// up to date as normals come in, it says at a glance whether d is the principal direction still.
struct PowerStep {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  /// `along` is the dot of `n` with the direction.
  void add(const StoredNormal& n, int along) {
    x += along * n.x;
    y += along * n.y;
    z += along * n.z;
  }
};

inline WideVector wide(const PowerStep& step) { return {step.x, step.y, step.z}; }

inline PowerStep power_step(const NormalSums& sums, const StoredNormal& direction) {
  const WideVector step = sums.squares * wide(direction);
  return {
      static_cast<std::int32_t>(step.x),
      static_cast<std::int32_t>(step.y),
      static_cast<std::int32_t>(step.z)};
}

/// True when `direction` is, up to its sign, the principal direction of `count` normals to about
/// 2 degrees, more than enough for a threshold of 90 +- 10: the step turns it by no more than that,
/// and its eigenvalue is more than half of the trace.
inline bool is_principal(const PowerStep& step, const StoredNormal& direction, int count) {
  constexpr int kMaxSqLength = 1 << 14;  // of a stored normal: 127^2, and some rounding
  const std::int64_t along = dot(wide(step), wide(direction));
  const WideVector off = cross(wide(step), wide(direction));
  const std::int64_t across = std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
  constexpr int kCotangent = 50;  // three components make a tangent of sqrt(3) / 50 at most
  return kCotangent * across < along &&
         2 * along > std::int64_t{kMaxSqLength} * kMaxSqLength * count;
}

/// The principal direction of a surface (spec §3.3): the dominant eigenvector of sum n n^T with the
/// sign of sum n; zero without normals. In integers, because a fused multiply-add here would
/// make maps differ between processors.
inline StoredNormal principal_direction(const NormalSums& sums) {
  // Where the normals agree, as on any wall, one step of the power iteration from their sum is all
  // it takes, and keeps the sum's sign: the matrix is positive.
  const StoredNormal guess = store_direction(sums.squares * sums.normals);
  if (is_principal(power_step(sums, guess), guess, sums.count)) {
    return guess;
  }
  const WideVector eigenvector = dominant_eigenvector(sums.squares);
  const std::int64_t sign = dot(eigenvector, sums.normals) < 0 ? -1 : 1;
  return store_direction({sign * eigenvector.x, sign * eigenvector.y, sign * eigenvector.z});
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
