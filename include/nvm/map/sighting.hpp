// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/map/map_point.hpp"
#include "nvm/map/view_direction.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Half the view direction (view_direction.hpp): stands in for the normal of a point whose plane is
/// not known, as of a ring that a spinning LiDAR has drawn on a floor. Wherever a map takes or
/// gives normals, a vector of length 1 is the normal of a plane and one of length 1/2 a sighting:
///
/// - VoxelMap::insert() stores a sighting like a normal that may be 90 degrees off: it chooses the
///   side, and nothing else. It neither turns the principal direction of its surface nor moves a
///   stored point. A later point with a normal takes its place.
/// - VoxelMap::nearest() with a normal finds only points that have one themselves, so that what is
///   not known to be a surface (edges, foliage) disturbs no plane. With a sighting it finds
///   both, of those that look at the sensor.
/// - associate() takes the plane of a sighting from the map (SightingOptions), and
///   settle_sightings() makes it a point with a normal that way.
template <class Point>
Eigen::Vector3f sighting(const Point& point, const Eigen::Vector3d& origin) {
  return 0.5F * view_direction(point, origin);
}

/// Whether a vector of this squared length is one, within 2 %; false for NaN. Numbers of one sign
/// are ordered as their bits are: see nvm/core/finite.hpp.
inline bool is_sighting_length(float sq_length) {
  constexpr std::uint32_t kShortest = 0x3e75c28fU;  // 0.24
  constexpr std::uint32_t kLongest = 0x3e851eb8U;   // 0.26
  std::uint32_t bits;
  std::memcpy(&bits, &sq_length, sizeof(bits));
  return bits - kShortest <= kLongest - kShortest;
}

/// True for a vector of half a unit's length.
inline bool is_sighting(const Eigen::Vector3f& normal) {
  return is_sighting_length(detail::sq_norm(normal));
}

/// `normal`, or zero for a sighting: for those who ask for planes only.
inline Eigen::Vector3f plane_normal(const Eigen::Vector3f& normal) {
  return is_sighting(normal) ? detail::zeros<Eigen::Vector3f>() : normal;
}
/// The points of a map but its sightings: those that are known to lie on a surface.
template <class Point>
std::vector<Point> without_sightings(std::vector<Point> points) {
  const auto is_seen = [](const Point& point) { return is_sighting(point.normal); };
  points.erase(std::remove_if(points.begin(), points.end(), is_seen), points.end());
  return points;
}

}  // namespace NVM_TARGET
}  // namespace nvm
