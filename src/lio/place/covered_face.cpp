// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/covered_face.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nvm::lio {

namespace {

constexpr double kTurn = 6.283185307179586;
constexpr std::size_t kMostNeighbors = 16;

/// The directions of points around a foot, in the plane.
struct Surroundings {
  std::array<double, kMostNeighbors> angles{};
  std::size_t size = 0;

  double widest_gap() {
    std::sort(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(size));
    double gap = angles[0] + kTurn - angles[size - 1];
    for (std::size_t i = 1; i < size; ++i) {
      gap = std::max(gap, angles[i] - angles[i - 1]);
    }
    return gap;
  }
};

}  // namespace

bool is_covered(
    const VoxelMap& map,
    const Eigen::Vector3d& foot,
    const Eigen::Vector3f& normal,
    VoxelMap::QueryContext& context) {
  constexpr double kFlat = 0.03;      // [m]
  constexpr float kLike = 0.9F;       // cosine between normals
  constexpr double kWidestGap = 2.6;  // between the directions of neighbours [rad]
  constexpr std::size_t kLeast = 3;
  constexpr double kReach = 1.6;        // of the spacing of the map's points
  constexpr double kLeastReach = 0.08;  // [m]
  const double reach = std::max(kLeastReach, kReach * map.options().min_point_distance);
  std::array<Neighbor, kMostNeighbors> found;
  const std::size_t most = map.nearest(foot, normal, {found.size(), reach}, found.data(), context);
  const Eigen::Vector3d n = normal.cast<double>();
  const Eigen::Vector3d u = n.unitOrthogonal();
  const Eigen::Vector3d v = n.cross(u);
  Surroundings surroundings;
  for (std::size_t i = 0; i < most; ++i) {
    const Eigen::Vector3d offset = found[i].position - foot;
    if (std::abs(n.dot(offset)) < kFlat && map.normal(found[i].id).dot(normal) > kLike) {
      surroundings.angles[surroundings.size++] = std::atan2(v.dot(offset), u.dot(offset));
    }
  }
  return surroundings.size >= kLeast && surroundings.widest_gap() < kWidestGap;
}

}  // namespace nvm::lio
