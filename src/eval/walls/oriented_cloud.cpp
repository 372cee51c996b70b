// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/oriented_cloud.hpp"

#include <algorithm>

#include "io/result/map_cloud.hpp"

namespace nvm::eval {

namespace {

/// `normal` at unit length, or zero where it is none.
Eigen::Vector3d unit_or_zero(const Eigen::Vector3f& normal) {
  constexpr float kMinLength = 0.5F;
  if (!(normal.norm() >= kMinLength) || !normal.allFinite()) {
    return Eigen::Vector3d::Zero();
  }
  return normal.cast<double>().normalized();
}

}  // namespace

bool OrientedCloud::has_normals() const {
  return std::any_of(points.begin(), points.end(), [](const OrientedPoint& point) {
    return !point.normal.isZero(0.0);
  });
}

OrientedCloud read_oriented_cloud(const std::string& path) {
  const io::MapCloud map = io::read_map_cloud(path);
  OrientedCloud cloud;
  for (std::size_t i = 0; i < map.positions.size(); ++i) {
    if (!map.positions[i].allFinite()) {
      ++cloud.non_finite;
      continue;
    }
    const Eigen::Vector3f normal =
        map.normals.empty() ? Eigen::Vector3f(Eigen::Vector3f::Zero()) : map.normals[i];
    cloud.points.push_back({map.positions[i], unit_or_zero(normal)});
  }
  return cloud;
}

OrientedCloud transformed(OrientedCloud cloud, const Pose& T) {
  for (OrientedPoint& point : cloud.points) {
    point.position = T * point.position;
    point.normal = T.linear() * point.normal;
  }
  return cloud;
}

}  // namespace nvm::eval
