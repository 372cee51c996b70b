// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_GEOMETRY_FLOAT_LANES_HPP  // a kernel: nvm/core/target.hpp
#define NVM_GEOMETRY_FLOAT_LANES_HPP

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__ARM_NEON)
#include <arm_neon.h>
#endif

#include "nvm/core/target.hpp"

// Arithmetic on several floats at once with the vector types of GCC and Clang: SSE2, AVX or NEON
// code from one source. Code that is a template over its number type runs on float, on double and
// on FloatLanes; on float and FloatLanes it gives the same bits.
NVM_BEGIN_KERNELS

/// Floats in one FloatLanes: as many as a register of the target holds.
#if defined(NVM_KERNEL_AVX)
inline constexpr std::size_t kLaneCount = 8;
#else
inline constexpr std::size_t kLaneCount = 4;
#endif

using FloatLanes = float __attribute__((vector_size(kLaneCount * sizeof(float))));
using FloatLaneBits = std::int32_t __attribute__((vector_size(kLaneCount * sizeof(float))));

// A template, so that its name tells the width: a program may hold code for several targets.
template <class Lanes = FloatLanes>
Lanes load_lanes(const float* values) {
  Lanes lanes;
  std::memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}

inline void store_lanes(const FloatLanes& lanes, float* values) {
  std::memcpy(values, &lanes, sizeof(lanes));
}

/// `value` as a Real: once per lane for FloatLanes.
template <class Real>
Real constant(double value) {
  return static_cast<float>(value) - Real{};
}
template <>
inline double constant<double>(double value) {
  return value;
}

/// a b + c: rounded once where the target has such an instruction, else twice.
template <class Real>
Real multiply_add(const Real& a, const Real& b, const Real& c) {
  return a * b + c;
}
#if defined(NVM_KERNEL_FMA) || (defined(__ARM_FEATURE_FMA) && defined(__ARM_NEON))
template <>
inline float multiply_add(const float& a, const float& b, const float& c) {
  return std::fma(a, b, c);
}
template <>
inline double multiply_add(const double& a, const double& b, const double& c) {
  return std::fma(a, b, c);
}
template <>
inline FloatLanes multiply_add(const FloatLanes& a, const FloatLanes& b, const FloatLanes& c) {
#if defined(NVM_KERNEL_FMA)
  return __builtin_ia32_vfmaddps256(a, b, c);
#else
  return vfmaq_f32(c, a, b);
#endif
}
#endif

template <class Real>
Real absolute(const Real& value) {
  return value < Real{} ? -value : value;
}

/// `a` where it is larger, else `b`; `b` where either is NaN.
template <class Real>
Real larger(const Real& a, const Real& b) {
  return a > b ? a : b;
}

template <class Real>
Real smaller(const Real& a, const Real& b) {
  return a < b ? a : b;
}

/// Bit i is set where lane i of the result of a comparison is true.
inline std::uint32_t lane_bits(const FloatLaneBits& mask) {
#if defined(NVM_KERNEL_AVX)
  // A builtin, because <immintrin.h> takes longer to include than all of nvm/normal.
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<FloatLanes>(mask)));
#elif defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < kLaneCount; ++lane) {
    bits |= static_cast<std::uint32_t>(mask[lane] & 1) << lane;
  }
  return bits;
#endif
}

NVM_END_KERNELS
NVM_BEGIN_DETAIL_KERNELS

// 1/sqrt by Newton steps from a first guess out of the float's bits. Plain arithmetic, because
// std::sqrt may set errno and therefore does not vectorise without -fno-math-errno.
template <class Real, class Bits>
Real newton_inverse_sqrt(const Real& value) {
  Bits bits;
  std::memcpy(&bits, &value, sizeof(bits));
  bits = 0x5f375a86 - (bits >> 1);
  Real y;
  std::memcpy(&y, &bits, sizeof(y));
  const Real half = 0.5F * value;
  for (int step = 0; step < 3; ++step) {
    y = y * multiply_add<Real>(-half * y, y, constant<Real>(1.5));
  }
  return y;
}

NVM_END_DETAIL_KERNELS
NVM_BEGIN_KERNELS

/// 1/sqrt(value) to 2 units in the last place for positive normal numbers; finite for zero.
inline FloatLanes inverse_sqrt(const FloatLanes& value) {
  return detail::newton_inverse_sqrt<FloatLanes, FloatLaneBits>(value);
}
inline float inverse_sqrt(float value) {
  return detail::newton_inverse_sqrt<float, std::int32_t>(value);
}
inline double inverse_sqrt(double value) { return value > 0.0 ? 1.0 / std::sqrt(value) : 0.0; }

NVM_END_KERNELS

#endif  // NVM_GEOMETRY_FLOAT_LANES_HPP
