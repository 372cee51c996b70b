// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/wall_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nvm::eval {

namespace {

/// True when `p` lies over the rectangle of `face`, off its edges. The margin leaves at least half
/// of a narrow face.
bool is_over(const WallFace& face, const Eigen::Vector3d& p, double margin) {
  const auto inner = [margin](double half) { return half - std::min(margin, 0.5 * half); };
  const Eigen::Vector3d offset = p - face.center;
  return std::abs(offset.dot(face.u)) <= inner(face.half_u) &&
         std::abs(offset.dot(face.v)) <= inner(face.half_v);
}

}  // namespace

SidedPoints wall_points(
    const OrientedCloud& cloud, const WallPiece& wall, const WallPointOptions& options) {
  const bool by_normal = cloud.has_normals();
  const double min_cosine = std::cos(options.max_normal_angle);
  const double reach = wall.thickness + options.reach;
  SidedPoints points;
  for (const OrientedPoint& point : cloud.points) {
    const auto distance = [&](std::size_t side) {
      return std::abs(wall.faces[side].plane.distance(point.position));
    };
    const std::size_t nearer = distance(0) <= distance(1) ? 0 : 1;
    for (std::size_t side = 0; side < 2; ++side) {
      const WallFace& face = wall.faces[side];
      const bool is_on_side =
          by_normal ? point.normal.dot(face.plane.normal) >= min_cosine : side == nearer;
      if (is_on_side && distance(side) <= reach && is_over(face, point.position, options.margin)) {
        points[side].push_back(point.position);
      }
    }
  }
  return points;
}

}  // namespace nvm::eval
