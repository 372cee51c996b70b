// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "nvm/map/storage/point_chunk.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

// Arithmetic on the eight points of a chunk at once, with the vector types of GCC and Clang: SSE2,
// AVX2 or NEON code from one source. Only what the compilers do not find by themselves is spelled
// in instructions. Everything is exact integer arithmetic, so every variant gives the same bits
// (tested against plain loops).
namespace nvm::detail {

// Passed by reference only: by value their ABI would depend on -march.
using IntLanes = std::int32_t __attribute__((vector_size(4 * kLanes)));
using ByteLanes = std::int8_t __attribute__((vector_size(kLanes)));
using ShortLanes = std::int16_t __attribute__((vector_size(2 * kLanes)));
using ShortPairs = std::int16_t __attribute__((vector_size(4 * kLanes)));

/// The coordinate of a query, once per lane.
struct LanePoint {
  explicit LanePoint(const WrappedPoint& point) : z(ShortLanes{} + point.z) {
    const std::uint32_t pair =
        (static_cast<std::uint32_t>(static_cast<std::uint16_t>(point.y)) << 16) |
        static_cast<std::uint16_t>(point.x);
    const IntLanes pairs = IntLanes{} + static_cast<std::int32_t>(pair);
    std::memcpy(&xy, &pairs, sizeof(xy));
  }
  ShortPairs xy;
  ShortLanes z;
};

/// out[i] = pairs[2 i]^2 + pairs[2 i + 1]^2.
[[gnu::always_inline]] inline void add_squares(const ShortPairs& pairs, IntLanes& out) {
#if defined(__AVX2__)
  __m256i v;
  std::memcpy(&v, &pairs, sizeof(v));
  v = _mm256_madd_epi16(v, v);
  std::memcpy(&out, &v, sizeof(v));
#elif defined(__SSE2__)
  __m128i v[2];
  std::memcpy(v, &pairs, sizeof(v));
  v[0] = _mm_madd_epi16(v[0], v[0]);
  v[1] = _mm_madd_epi16(v[1], v[1]);
  std::memcpy(&out, v, sizeof(v));
#else
  IntLanes both;
  std::memcpy(&both, &pairs, sizeof(both));
  const IntLanes low = (both << 16) >> 16;
  const IntLanes high = both >> 16;
  out = low * low + high * high;
#endif
}

/// Squared distances in lattice steps of the chunk's points to `query`, correct for points less
/// than 4 voxels away in each axis; lanes without a point hold garbage.
[[gnu::always_inline]] inline void sq_distances(
    const PointChunk& chunk, const LanePoint& query, IntLanes& out) {
  ShortPairs xy;
  ShortLanes z;
  std::memcpy(&xy, chunk.xy, sizeof(xy));
  std::memcpy(&z, chunk.z, sizeof(z));
  const ShortPairs dxy = xy - query.xy;
  const ShortLanes dz = z - query.z;
  IntLanes sq_xy;
  add_squares(dxy, sq_xy);
  const IntLanes wide_dz = __builtin_convertvector(dz, IntLanes);
  out = sq_xy + wide_dz * wide_dz;
}

/// Bit i is set when values[i] < limit.
[[gnu::always_inline]] inline std::uint32_t lanes_below(
    const IntLanes& values, std::int32_t limit) {
#if defined(__AVX2__)
  __m256i v;
  std::memcpy(&v, &values, sizeof(v));
  const __m256i below = _mm256_cmpgt_epi32(_mm256_set1_epi32(limit), v);
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(below)));
#else
  std::uint32_t mask = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    mask |= static_cast<std::uint32_t>(values[lane] < limit) << lane;
  }
  return mask;
#endif
}

#if defined(__AVX2__) && !defined(__AVX512VL__)
/// Entry m: the set bits of m in ascending order, one byte each.
inline constexpr auto kSetBits = [] {
  std::array<std::uint64_t, 256> table{};
  for (std::size_t mask = 0; mask < table.size(); ++mask) {
    int shift = 0;
    for (std::uint64_t bit = 0; bit < kLanes; ++bit) {
      if ((mask >> bit & 1U) != 0) {
        table[mask] |= bit << shift;
        shift += 8;
      }
    }
  }
  return table;
}();
#endif

/// Writes the lanes of `mask` to `out` without gaps. Writes up to kLanes elements, garbage behind
/// the last.
[[gnu::always_inline]] inline void compress(
    std::uint32_t mask, const IntLanes& values, std::int32_t* out) {
#if defined(__AVX512VL__)
  __m256i v;
  std::memcpy(&v, &values, sizeof(v));
  v = _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), v);
  std::memcpy(out, &v, sizeof(v));
#elif defined(__AVX2__)
  __m256i v;
  std::memcpy(&v, &values, sizeof(v));
  const __m256i order =
      _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<std::int64_t>(kSetBits[mask])));
  v = _mm256_permutevar8x32_epi32(v, order);
  std::memcpy(out, &v, sizeof(v));
#else
  for (; mask != 0; mask &= mask - 1) {
    *out++ = values[__builtin_ctz(mask)];
  }
#endif
}

/// Bit i is set for the first `count` lanes.
inline std::uint32_t first_lanes(int count) { return count >= kLanes ? 0xffU : (1U << count) - 1U; }

/// Bit i is set when the dot of normal i with `normal` exceeds `threshold`.
[[gnu::always_inline]] inline std::uint32_t lanes_facing(
    const NormalChunk& chunk, const StoredNormal& normal, int threshold) {
  ByteLanes x;
  ByteLanes y;
  ByteLanes z;
  std::memcpy(&x, chunk.x, sizeof(x));
  std::memcpy(&y, chunk.y, sizeof(y));
  std::memcpy(&z, chunk.z, sizeof(z));
  const IntLanes dots = __builtin_convertvector(x, IntLanes) * normal.x +
                        __builtin_convertvector(y, IntLanes) * normal.y +
                        __builtin_convertvector(z, IntLanes) * normal.z;
  return lanes_below(-dots, -threshold);
}

}  // namespace nvm::detail
