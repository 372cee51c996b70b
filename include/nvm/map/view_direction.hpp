// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "nvm/core/finite.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// The direction from `point` to the sensor at `origin`, as a unit vector: a stand-in for the
/// normal of a host that has none. It tells the two faces of a wall apart, because a sensor sees
/// only faces that look at it. Zero when the two coincide or are not finite.
template <class Point>
Eigen::Vector3f view_direction(const Point& point, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d ray = origin - position(point);
  const double length = ray.norm();
  const bool valid = detail::is_finite(length) && length > 0.0 && length <= 1e12;
  return detail::per_axis(
      [&](int axis) { return valid ? static_cast<float>(ray[axis] / length) : 0.0F; });
}

/// The view directions of a range of points, computed when read: `map.insert(points,
/// view_directions(points, origin))`. Refers to `points`, which must live as long. `origin` is in
/// the frame of the points.
template <class Points>
class ViewDirections {
 public:
  ViewDirections(const Points& points, const Eigen::Vector3d& origin)
      : points_(points), origin_(origin) {}

  std::size_t size() const { return static_cast<std::size_t>(points_.size()); }
  Eigen::Vector3f operator[](std::size_t i) const { return view_direction(points_[i], origin_); }

 private:
  const Points& points_;
  Eigen::Vector3d origin_;
};

template <class Points>
ViewDirections<Points> view_directions(const Points& points, const Eigen::Vector3d& origin) {
  static_assert(
      is_point_range_v<Points>, "nvm: points must be a range of points: size(), [] and x, y, z");
  return {points, origin};
}

}  // namespace NVM_TARGET
}  // namespace nvm
