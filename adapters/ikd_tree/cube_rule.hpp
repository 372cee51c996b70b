// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "adapters/common/host_map.hpp"

namespace nvm::adapters {

/// ikd-Tree's rule for points that are added with downsampling: of each cube of edge `cube` [m],
/// [floor(x / cube) cube, + cube) per axis, only the point nearest to the centre stays. Here of
/// each cube and side, so that a thin wall keeps both faces. True when `point` stays. The map must
/// have been made.
template <class Point>
bool insert_nearest_to_center(HostMap& host, const Point& point, double cube) {
  const Eigen::Vector3d position = nvm::position(point);
  if (!position.allFinite()) {
    return false;
  }
  VoxelMap& map = *host.map();
  const Eigen::Vector3d low = (position / cube).array().floor() * cube;
  const Eigen::Vector3d center = low.array() + 0.5 * cube;
  const double sq_distance = (position - center).squaredNorm();
  const Eigen::Vector3f normal = host.normals().insert_normal(point);
  constexpr double kHalfDiagonal = 0.867;
  bool stays = true;
  std::size_t replaced = 0;
  std::vector<Eigen::Vector3d> other_points;
  std::vector<Eigen::Vector3f> other_normals;
  map.for_each_within(center, kHalfDiagonal * cube, [&](const Neighbor& stored) {
    const Eigen::Array3d inside = stored.position - low;
    if (inside.minCoeff() < 0.0 || inside.maxCoeff() >= cube) {
      return;
    }
    if (map.normal(stored.id).dot(normal) < 0.0F) {
      other_points.push_back(stored.position);
      other_normals.push_back(map.normal(stored.id));
      return;
    }
    ++replaced;
    stays = stays && sq_distance < stored.sq_distance;
  });
  if (!stays) {
    return false;
  }
  if (replaced > 0) {
    map.erase_box(low, low.array() + cube * (1.0 - 1e-9));
    host.insert(other_points, other_normals);
  }
  host.insert(std::array<Point, 1>{point});
  return true;
}

}  // namespace nvm::adapters
