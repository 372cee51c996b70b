// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/plane_frame.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace nvm::survey {

PlaneFrame plane_frame(
    const eval::OrientedPlane& plane,
    const Eigen::Vector3d& near,
    const Eigen::Vector3d& along,
    const Eigen::Vector3d& up) {
  constexpr double kLevel = 0.70710678;
  const Eigen::Vector3d& n = plane.normal;
  PlaneFrame frame;
  frame.origin = near - plane.distance(near) * n;
  if (std::abs(n.dot(up)) < kLevel) {
    frame.u = up.cross(n).normalized();
  } else {
    frame.u = (along - along.dot(n) * n).normalized();
  }
  frame.v = n.cross(frame.u);
  return frame;
}

PlaneBox box_in(const PlaneFrame& to, const PlaneFrame& from, const PlaneBox& box) {
  PlaneBox result;
  for (const double u : {box.min_u, box.max_u}) {
    for (const double v : {box.min_v, box.max_v}) {
      const Eigen::Vector3d corner = from.point(u, v);
      result.extend(to.coordinate_u(corner), to.coordinate_v(corner));
    }
  }
  return result;
}

}  // namespace nvm::survey
