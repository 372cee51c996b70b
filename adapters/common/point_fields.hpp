// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "nvm/map/neighbor.hpp"

namespace nvm::adapters {

namespace detail {

template <class Point, class = void>
struct HasNormalFields : std::false_type {};
template <class Point>
struct HasNormalFields<
    Point,
    std::void_t<
        decltype(std::declval<Point&>().normal_x),
        decltype(std::declval<Point&>().normal_y),
        decltype(std::declval<Point&>().normal_z)>> : std::true_type {};

}  // namespace detail

/// True for records with members normal_x, normal_y, normal_z, as PCL's.
template <class Point>
inline constexpr bool has_normal_fields_v = detail::HasNormalFields<Point>::value;

/// True when `normal` is finite and of length 1 within 1 %, which is what the map takes.
inline bool is_unit_normal(const Eigen::Vector3f& normal) noexcept {
  const float sq_length = normal.squaredNorm();
  return sq_length > 0.98F && sq_length < 1.02F;
}

/// What the host left in the normal fields of `point`; zero when it has none.
template <class Point>
Eigen::Vector3f normal_field(const Point& point) noexcept {
  if constexpr (has_normal_fields_v<Point>) {
    return {
        static_cast<float>(point.normal_x),
        static_cast<float>(point.normal_y),
        static_cast<float>(point.normal_z)};
  } else {
    return Eigen::Vector3f::Zero();
  }
}

template <class Point>
void set_position(Point& point, const Eigen::Vector3d& position) {
  point.x = static_cast<decltype(point.x)>(position.x());
  point.y = static_cast<decltype(point.y)>(position.y());
  point.z = static_cast<decltype(point.z)>(position.z());
}

/// A host's point at `position` [m]; its other fields are as a new point has them.
template <class Point>
Point make_point(const Eigen::Vector3d& position) {
  Point point{};
  set_position(point, position);
  return point;
}

/// Replaces the contents of `points`, a vector of a host's points, by `count` new ones at the
/// positions of `found`. They are made where they stay: to copy points whose parts have just been
/// written stalls the processor.
template <class PointVector>
void write_positions(const Neighbor* found, std::size_t count, PointVector& points) {
  points.resize(count);
  auto* to = points.data();
  for (const Neighbor* from = found; from != found + count; ++from, ++to) {
    *to = typename PointVector::value_type{};
    set_position(*to, from->position);
  }
}

/// Sets the normal fields of `point`; nothing when it has none.
template <class Point>
void set_normal(Point& point, const Eigen::Vector3f& normal) {
  if constexpr (has_normal_fields_v<Point>) {
    point.normal_x = normal.x();
    point.normal_y = normal.y();
    point.normal_z = normal.z();
  }
}

/// make_point with a normal.
template <class Point>
Point make_point(const Eigen::Vector3d& position, const Eigen::Vector3f& normal) {
  Point point = make_point<Point>(position);
  set_normal(point, normal);
  return point;
}

}  // namespace nvm::adapters
