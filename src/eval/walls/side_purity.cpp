// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/side_purity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/median.hpp"

namespace nvm::eval {

namespace {

std::vector<double> distances(
    const std::vector<Eigen::Vector3d>& points, const OrientedPlane& plane) {
  std::vector<double> result;
  result.reserve(points.size());
  for (const Eigen::Vector3d& p : points) {
    result.push_back(plane.distance(p));
  }
  return result;
}

/// Sides of the points at these distances in front of their own face (negative: behind it).
SideCount count_side(const std::vector<double>& distances, double thickness) {
  constexpr double kNoiseReach = 0.05;  // how far beyond a face its points can lie [m]
  SideCount count;
  for (const double distance : distances) {
    const double excess = std::abs(distance) - thickness;
    if (excess > kNoiseReach) {
      continue;  // another surface
    }
    ++count.points;
    if (excess > 0.0) {
      count.wrong += distance < 0.0 ? 2.0 : -2.0;
    }
  }
  return count;
}

}  // namespace

std::optional<double> SideCount::purity() const {
  if (points == 0) {
    return std::nullopt;
  }
  return std::clamp(1.0 - wrong / static_cast<double>(points), 0.0, 1.0);
}

SideCount count_sides(const SidedPoints& points, const WallPiece& wall) {
  std::vector<double> first = distances(points[0], wall.faces[0].plane);
  std::vector<double> second = distances(points[1], wall.faces[1].plane);
  if (first.empty() || second.empty()) {
    return {};
  }
  const double shift = 0.5 * (median(first) - median(second));  // along the first face's normal
  for (double& distance : first) {
    distance -= shift;
  }
  for (double& distance : second) {
    distance += shift;
  }
  SideCount count = count_side(first, wall.thickness);
  count += count_side(second, wall.thickness);
  return count;
}

}  // namespace nvm::eval
