// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <vector>

namespace nvm::test {

/// Laid out as pcl::PointXYZINormal, which FAST_LIO, faster-lio and Point-LIO call PointType: 48
/// bytes, aligned to 16.
struct alignas(16) HostPoint {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  float one = 1.0F;
  float normal_x = 0.0F;
  float normal_y = 0.0F;
  float normal_z = 0.0F;
  float zero = 0.0F;
  float intensity = 0.0F;
  float curvature = 0.0F;
  float padding[2] = {0.0F, 0.0F};
};
static_assert(sizeof(HostPoint) == 48);

using HostPoints = std::vector<HostPoint, Eigen::aligned_allocator<HostPoint>>;

inline HostPoint host_point(const Eigen::Vector3d& position) {
  HostPoint point;
  point.x = static_cast<float>(position.x());
  point.y = static_cast<float>(position.y());
  point.z = static_cast<float>(position.z());
  point.curvature = 42.0F;  // hosts keep times here
  return point;
}

inline HostPoint host_point(const Eigen::Vector3d& position, const Eigen::Vector3f& normal) {
  HostPoint point = host_point(position);
  point.normal_x = normal.x();
  point.normal_y = normal.y();
  point.normal_z = normal.z();
  return point;
}

template <class Points>
HostPoints host_points(const Points& points) {
  HostPoints result;
  for (const auto& point : points) {
    result.push_back(host_point(point));
  }
  return result;
}

template <class Cloud>
HostPoints host_points_with_normals(const Cloud& cloud) {
  HostPoints result;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    result.push_back(host_point(cloud.points[i], cloud.normals[i]));
  }
  return result;
}

}  // namespace nvm::test
