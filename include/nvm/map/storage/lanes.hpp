// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_MAP_STORAGE_LANES_HPP  // a kernel: nvm/core/target.hpp
#define NVM_MAP_STORAGE_LANES_HPP

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/point_chunk.hpp"

#if defined(__AVX512VL__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

// Arithmetic on the eight points of a chunk at once, with the vector types of GCC and Clang: SSE2,
// AVX2 or NEON code from one source. Only what the compilers do not find by themselves is spelled
// in instructions; those of AVX2 by their builtins, because <immintrin.h> takes two thirds as long
// to include as all of the map. Everything is exact integer arithmetic, so every variant gives the
// same bits (tested against plain loops).
NVM_BEGIN_DETAIL_KERNELS

// Passed by reference only: by value their ABI would depend on -march.
using IntLanes = std::int32_t __attribute__((vector_size(4 * kLanes)));
using UnsignedLanes = std::uint32_t __attribute__((vector_size(4 * kLanes)));
using ShortLanes = std::int16_t __attribute__((vector_size(2 * kLanes)));
using ShortPairs = std::int16_t __attribute__((vector_size(4 * kLanes)));
// Wrapped coordinates: their differences may wrap around, which only unsigned numbers may.
using WrappedLanes = std::uint16_t __attribute__((vector_size(2 * kLanes)));
using WrappedPairs = std::uint16_t __attribute__((vector_size(4 * kLanes)));

/// The coordinate of a query, once per lane.
struct LanePoint {
  explicit LanePoint(const WrappedPoint& point)
      : z(WrappedLanes{} + static_cast<std::uint16_t>(point.z)) {
    const std::int16_t both[2] = {point.x, point.y};  // in memory as in a chunk
    std::int32_t pair;
    std::memcpy(&pair, both, sizeof(pair));
    const IntLanes pairs = IntLanes{} + pair;
    std::memcpy(&xy, &pairs, sizeof(xy));
  }
  WrappedPairs xy;
  WrappedLanes z;
};

/// out[i] = pairs[2 i]^2 + pairs[2 i + 1]^2.
[[gnu::always_inline]] inline void add_squares(const ShortPairs& pairs, IntLanes& out) {
#if defined(NVM_KERNEL_AVX2)
  out = __builtin_ia32_pmaddwd256(pairs, pairs);
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
  out = reinterpret_cast<IntLanes>(
      reinterpret_cast<UnsignedLanes>(low * low) + reinterpret_cast<UnsignedLanes>(high * high));
#endif
}

/// Squared distances in lattice steps, as unsigned numbers, of the chunk's lanes to `query`,
/// correct for lanes at most 4 voxels away in each axis.
[[gnu::always_inline]] inline void sq_distances(
    const PointChunk& chunk, const LanePoint& query, IntLanes& out) {
  WrappedPairs xy;
  WrappedLanes z;
  std::memcpy(&xy, chunk.xy, sizeof(xy));
  std::memcpy(&z, chunk.z, sizeof(z));
  const WrappedPairs dxy = xy - query.xy;
  const WrappedLanes dz = z - query.z;
  const UnsignedLanes dz_and_zero = __builtin_convertvector(dz, UnsignedLanes);
  IntLanes sq_xy;
  IntLanes sq_z;
  add_squares(reinterpret_cast<ShortPairs>(dxy), sq_xy);
  add_squares(reinterpret_cast<ShortPairs>(dz_and_zero), sq_z);
  out = reinterpret_cast<IntLanes>(
      reinterpret_cast<UnsignedLanes>(sq_xy) + reinterpret_cast<UnsignedLanes>(sq_z));
}

/// Bit i is set when values[i], as an unsigned number, is below `limit`, which is not negative.
[[gnu::always_inline]] inline std::uint32_t lanes_below(
    const IntLanes& values, std::int32_t limit) {
#if defined(NVM_KERNEL_AVX2)
  constexpr std::int32_t kSign = std::numeric_limits<std::int32_t>::min();
  const IntLanes below = (values ^ kSign) < (IntLanes{} + (limit ^ kSign));
  using Floats = float __attribute__((vector_size(4 * kLanes)));
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<Floats>(below)));
#else
  std::uint32_t mask = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    const bool is_below =
        static_cast<std::uint32_t>(values[lane]) < static_cast<std::uint32_t>(limit);
    mask |= static_cast<std::uint32_t>(is_below) << lane;
  }
  return mask;
#endif
}

#if defined(NVM_KERNEL_AVX2) && !defined(__AVX512VL__)
/// Entry m: the set bits of m in ascending order, one byte each.
template <class>
inline constexpr auto kSetBits = [] {
  std::array<std::uint64_t, 256> table{};
  for (std::size_t mask = 0; mask < table.size(); ++mask) {
    int shift = 0;
    for (std::size_t left = mask; left != 0; left &= left - 1, shift += 8) {
      table[mask] |= static_cast<std::uint64_t>(__builtin_ctzll(left)) << shift;
    }
  }
  return table;
}();

/// The same, one lane each.
template <class Unused = void>
[[gnu::always_inline]] inline void set_bits(std::uint32_t mask, IntLanes& out) {
#ifdef __clang__
  std::uint8_t __attribute__((vector_size(kLanes))) bits;
  std::memcpy(&bits, &kSetBits<Unused>[mask], sizeof(bits));
  out = __builtin_convertvector(bits, IntLanes);
#else  // GCC would unpack them one by one
  const long long __attribute__((vector_size(16)))
  bits{static_cast<long long>(kSetBits<Unused>[mask])};
  out = __builtin_ia32_pmovzxbd256(reinterpret_cast<char __attribute__((vector_size(16)))>(bits));
#endif
}
#endif

/// Writes the lanes of `mask` to `out` without gaps. Writes up to kLanes elements, garbage behind
/// the last.
template <class = void>
[[gnu::always_inline]] inline void compress(
    std::uint32_t mask, const IntLanes& values, std::int32_t* out) {
#if defined(__AVX512VL__)
  __m256i v;
  std::memcpy(&v, &values, sizeof(v));
  v = _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), v);
  std::memcpy(out, &v, sizeof(v));
#elif defined(NVM_KERNEL_AVX2)
  IntLanes order;
  set_bits(mask, order);
  const IntLanes v = __builtin_ia32_permvarsi256(values, order);
  std::memcpy(out, &v, sizeof(v));
#else
  for (; mask != 0; mask &= mask - 1) {
    *out++ = values[__builtin_ctz(mask)];
  }
#endif
}

[[gnu::always_inline]] inline std::int32_t sum_of(const IntLanes& values) {
  std::int32_t sum = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    sum += values[lane];
  }
  return sum;
}

/// The nearest lane of those in `mask`, which has some, by sq_distances(), which are large where
/// there is no point; of equally near ones the first.
[[gnu::always_inline]] inline int nearest_lane(const IntLanes& distances, std::uint32_t mask) {
  const auto sq_distance = [&](int lane) { return static_cast<std::uint32_t>(distances[lane]); };
  int nearest = __builtin_ctz(mask);
  for (int lane = nearest + 1; lane < kLanes; ++lane) {
    const bool is_nearer = sq_distance(lane) < sq_distance(nearest);
    nearest = (mask >> lane & 1U) != 0 && is_nearer ? lane : nearest;
  }
  return nearest;
}

/// Bit i is set when values[i] > limit.
[[gnu::always_inline]] inline std::uint32_t lanes_above(
    const ShortLanes& values, std::int16_t limit) {
#if defined(__SSE2__)
  __m128i v;
  std::memcpy(&v, &values, sizeof(v));
  const __m128i above = _mm_cmpgt_epi16(v, _mm_set1_epi16(limit));
  return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(above, _mm_setzero_si128())));
#else
  std::uint32_t mask = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    mask |= static_cast<std::uint32_t>(values[lane] > limit) << lane;
  }
  return mask;
#endif
}

/// Eight components of normals, from `bytes`.
[[gnu::always_inline]] inline void widen(const std::int8_t* bytes, WrappedLanes& out) {
#if defined(__SSE2__)
  __m128i v = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes));
  v = _mm_srai_epi16(_mm_unpacklo_epi8(v, v), 8);
  std::memcpy(&out, &v, sizeof(v));
#else
  std::int8_t __attribute__((vector_size(kLanes))) lanes;
  std::memcpy(&lanes, bytes, sizeof(lanes));
  out = reinterpret_cast<WrappedLanes>(__builtin_convertvector(lanes, ShortLanes));
#endif
}

/// Bit i is set when normal i is a sighting.
[[gnu::always_inline]] inline std::uint32_t lanes_sighted(const NormalChunk& chunk) {
  WrappedLanes x;
  WrappedLanes y;
  WrappedLanes z;
  widen(chunk.x, x);
  widen(chunk.y, y);
  widen(chunk.z, z);
  const auto sq_lengths = reinterpret_cast<ShortLanes>(x * x + y * y + z * z);
  return lanes_above(sq_lengths, 0) & ~lanes_above(sq_lengths, kMinSqNormal - 1);
}

/// Bit i is set when the dot of normal i with `normal` exceeds `threshold`.
[[gnu::always_inline]] inline std::uint32_t lanes_facing(
    const NormalChunk& chunk, const StoredNormal& normal, int threshold) {
  WrappedLanes x;
  WrappedLanes y;
  WrappedLanes z;
  widen(chunk.x, x);
  widen(chunk.y, y);
  widen(chunk.z, z);
  // The dot of two unit vectors fits into 16 bits, whatever wraps around on the way.
  const WrappedLanes dots = x * static_cast<std::uint16_t>(normal.x) +
                            y * static_cast<std::uint16_t>(normal.y) +
                            z * static_cast<std::uint16_t>(normal.z);
  return lanes_above(reinterpret_cast<ShortLanes>(dots), static_cast<std::int16_t>(threshold));
}

NVM_END_DETAIL_KERNELS

#endif  // NVM_MAP_STORAGE_LANES_HPP
