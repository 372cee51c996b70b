// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "eval/walls/oriented_plane.hpp"

namespace nvm::survey {

/// Coordinates (u, v) [m] in a plane. In all but level planes v points up and u is level.
struct PlaneFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< on the plane [m]
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();      ///< unit vectors; u x v is the plane's normal
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();

  double coordinate_u(const Eigen::Vector3d& p) const { return u.dot(p - origin); }
  double coordinate_v(const Eigen::Vector3d& p) const { return v.dot(p - origin); }
  Eigen::Vector3d point(double at_u, double at_v) const { return origin + at_u * u + at_v * v; }
};

/// The frame of `plane` with its origin nearest to `near`; `along` and `up` are unit vectors across
/// each other. Level planes (within 45 degrees) have u along `along`.
PlaneFrame plane_frame(
    const eval::OrientedPlane& plane,
    const Eigen::Vector3d& near,
    const Eigen::Vector3d& along,
    const Eigen::Vector3d& up);

/// An interval of both coordinates of a plane frame; empty when default-constructed.
struct PlaneBox {
  double min_u = std::numeric_limits<double>::infinity();
  double max_u = -std::numeric_limits<double>::infinity();
  double min_v = std::numeric_limits<double>::infinity();
  double max_v = -std::numeric_limits<double>::infinity();

  void extend(double u, double v) {
    min_u = std::min(min_u, u);
    max_u = std::max(max_u, u);
    min_v = std::min(min_v, v);
    max_v = std::max(max_v, v);
  }
  double width() const { return max_u - min_u; }
  double height() const { return max_v - min_v; }

  /// How far apart two boxes are; 0 when they touch.
  double gap(const PlaneBox& other) const {
    const double gap_u = std::max(min_u, other.min_u) - std::min(max_u, other.max_u);
    const double gap_v = std::max(min_v, other.min_v) - std::min(max_v, other.max_v);
    return std::max({gap_u, gap_v, 0.0});
  }
};

/// What `box`, of the frame `from`, covers in the frame `to`.
PlaneBox box_in(const PlaneFrame& to, const PlaneFrame& from, const PlaneBox& box);

}  // namespace nvm::survey
