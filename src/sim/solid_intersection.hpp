// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>

#include "sim/scene.hpp"

namespace nvm::sim {

/// Where a ray enters a solid, in double precision.
struct Entry {
  double range = 0.0;      ///< along the ray, positive [m]
  Eigen::Vector3d normal;  ///< unit, against the ray
  std::uint32_t face = 0;
};

/// Range at which the ray meets the plane {p : normal . p = offset}; not finite when parallel.
inline double plane_range(
    const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction,
    const Eigen::Vector3d& normal,
    double offset) {
  return (offset - normal.dot(origin)) / normal.dot(direction);
}

/// Where the ray enters `cylinder` from outside; face 0 is the side, 1 the ends.
inline std::optional<Entry> enter_cylinder(
    const Cylinder& cylinder, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Pose& T_world_cylinder = cylinder.T_world_cylinder;
  const Eigen::Vector3d o =
      T_world_cylinder.linear().transpose() * (origin - T_world_cylinder.translation());
  const Eigen::Vector3d d = T_world_cylinder.linear().transpose() * direction;

  const double a = d.head<2>().squaredNorm();
  const double half_b = o.head<2>().dot(d.head<2>());
  const double c = o.head<2>().squaredNorm() - cylinder.radius * cylinder.radius;
  const double discriminant = half_b * half_b - a * c;
  if (discriminant > 0.0 && half_b < 0.0) {
    const double range = (-half_b - std::sqrt(discriminant)) / a;
    const Eigen::Vector3d p = o + range * d;
    if (range > 0.0 && std::abs(p.z()) <= cylinder.half_height) {
      const Eigen::Vector3d normal(p.x() / cylinder.radius, p.y() / cylinder.radius, 0.0);
      return Entry{range, T_world_cylinder.linear() * normal, 0};
    }
  }
  const double end = o.z() > 0.0 ? cylinder.half_height : -cylinder.half_height;
  const double range = (end - o.z()) / d.z();
  const bool from_outside = d.z() * end < 0.0 && range > 0.0;
  if (from_outside && (o + range * d).head<2>().norm() <= cylinder.radius) {
    return Entry{range, T_world_cylinder.linear() * Eigen::Vector3d(0.0, 0.0, end).normalized(), 1};
  }
  return std::nullopt;
}

}  // namespace nvm::sim
