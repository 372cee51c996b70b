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

}  // namespace nvm::survey
