// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace nvm::detail {

/// A unit normal in 3 bytes, accurate to 0.4 degrees: it tells sides apart and orients exported
/// maps; planes are fitted to positions. The zero vector stands for "no normal".
struct StoredNormal {
  std::int8_t x = 0;
  std::int8_t y = 0;
  std::int8_t z = 0;
};

inline bool operator==(const StoredNormal& a, const StoredNormal& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

inline constexpr int kNormalScale = 127;

/// True for a finite vector whose length is 1 within 1 %.
inline bool is_unit(const Eigen::Vector3f& normal) {
  const float sq_length = normal.squaredNorm();
  return sq_length > 0.98F && sq_length < 1.02F;
}

/// `normal` must be a unit vector (or zero).
inline StoredNormal store_normal(const Eigen::Vector3f& normal) {
  const auto round = [](float value) {
    return static_cast<std::int8_t>(
        std::nearbyint(std::fmin(std::fmax(value, -1.0F), 1.0F) * kNormalScale));
  };
  return {round(normal.x()), round(normal.y()), round(normal.z())};
}

inline Eigen::Vector3f load_normal(const StoredNormal& normal) {
  const Eigen::Vector3f vector(normal.x, normal.y, normal.z);
  const float length = vector.norm();
  return length > 0.0F ? Eigen::Vector3f(vector / length) : Eigen::Vector3f::Zero();
}

/// 127^2 times the cosine of the angle between two normals.
inline int dot(const StoredNormal& a, const StoredNormal& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Two stored normals are within `angle` [rad] when their dot exceeds this. Angles are compared by
/// their cosines: acos of the dot of two equal normals is NaN as often as not.
inline int dot_threshold(double angle) {
  return static_cast<int>(std::floor(std::cos(angle) * kNormalScale * kNormalScale + 1e-9));
}

}  // namespace nvm::detail
