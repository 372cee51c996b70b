// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// A unit normal in 3 bytes, accurate to 0.4 degrees: it tells sides apart and orients exported
/// maps; planes are fitted to positions. One of half the length is a sighting (sighting.hpp), the
/// zero vector stands for "no normal".
struct StoredNormal {
  std::int8_t x = 0;
  std::int8_t y = 0;
  std::int8_t z = 0;
};

inline bool operator==(const StoredNormal& a, const StoredNormal& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

inline constexpr int kNormalScale = 127;

/// True when a vector of this squared length is a unit vector, within 1 %; false for NaN. Numbers
/// of one sign are ordered as their bits are: see nvm/core/finite.hpp.
inline bool is_unit_length(float sq_length) {
  constexpr std::uint32_t kShortest = 0x3f7ae148U;  // 0.98
  constexpr std::uint32_t kLongest = 0x3f828f5cU;   // 1.02
  std::uint32_t bits;
  std::memcpy(&bits, &sq_length, sizeof(bits));
  return bits - kShortest <= kLongest - kShortest;
}
inline bool is_unit(const Eigen::Vector3f& normal) { return is_unit_length(sq_norm(normal)); }

/// Stored normals are shorter than this when squared if they are sightings: three quarters of
/// kNormalScale, midway between the two lengths.
inline constexpr int kMinSqNormal = 9073;

/// A component of a unit vector, rounded. (Adding 128 first turns truncation into rounding for
/// either sign.)
inline std::int8_t store_component(float value) {
  const int rounded = static_cast<int>(value * kNormalScale + 128.5F) - 128;
  return static_cast<std::int8_t>(std::min(std::max(rounded, -kNormalScale), kNormalScale));
}

/// `normal` must be a unit vector (or zero).
inline StoredNormal store_normal(const Eigen::Vector3f& normal) {
  return {store_component(normal.x()), store_component(normal.y()), store_component(normal.z())};
}

/// 127^2 times the cosine of the angle between two normals.
inline int dot(const StoredNormal& a, const StoredNormal& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline bool is_sighting(const StoredNormal& normal) {
  const int sq_length = dot(normal, normal);
  return sq_length > 0 && sq_length < kMinSqNormal;
}
/// The unit vector along a sighting.
inline StoredNormal view_of(const StoredNormal& sighting) {
  const auto twice = [](std::int8_t component) {
    return static_cast<std::int8_t>(std::clamp(2 * component, -kNormalScale, kNormalScale));
  };
  return {twice(sighting.x), twice(sighting.y), twice(sighting.z)};
}

/// Of the length that it stands for: 1, half, or 0.
inline Eigen::Vector3f load_normal(const StoredNormal& normal) {
  const Eigen::Vector3f vector(normal.x, normal.y, normal.z);
  const float norm = std::sqrt(sq_norm(vector));
  const float length = is_sighting(normal) ? 2.0F * norm : norm;
  return per_axis([&](int axis) { return length > 0.0F ? vector[axis] / length : 0.0F; });
}

/// Two stored normals are within `angle` [rad] when their dot exceeds this. Angles are compared by
/// their cosines: acos of the dot of two equal normals is NaN as often as not.
inline int dot_threshold(double angle) {
  return static_cast<int>(std::floor(std::cos(angle) * kNormalScale * kNormalScale + 1e-9));
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
