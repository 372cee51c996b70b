// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/region.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "config/schema.hpp"

namespace nvm::eval {

namespace {

Eigen::Matrix3d R_world_region(const Region& region) {
  const Eigen::Vector3d angles = region.rotation_deg * (3.14159265358979323846 / 180.0);
  return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

std::vector<OrientedPoint> points_in(const OrientedCloud& cloud, const Region& region) {
  const Eigen::Matrix3d R_region_world = R_world_region(region).transpose();
  std::vector<OrientedPoint> inside;
  for (const OrientedPoint& point : cloud.points) {
    const Eigen::Vector3d p = R_region_world * (point.position - region.center);
    if ((p.cwiseAbs() - 0.5 * region.size).maxCoeff() <= 0.0) {
      inside.push_back(point);
    }
  }
  return inside;
}

/// The direction that the normals have in common, whatever their signs.
Eigen::Vector3d main_axis(const std::vector<OrientedPoint>& points) {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const OrientedPoint& point : points) {
    moment += point.normal * point.normal.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).eigenvectors().col(2);
}

/// The offset along `normal` around which `points` (at least one) lie densest.
double densest_offset(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& normal) {
  constexpr double kWindow = 0.03;  // [m]
  std::vector<double> offsets;
  offsets.reserve(points.size());
  for (const Eigen::Vector3d& p : points) {
    offsets.push_back(normal.dot(p));
  }
  std::sort(offsets.begin(), offsets.end());
  std::size_t begin = 0;
  std::size_t best_begin = 0;
  std::size_t best_count = 0;
  for (std::size_t end = 0; end < offsets.size(); ++end) {
    while (offsets[end] - offsets[begin] > kWindow) {
      ++begin;
    }
    if (end - begin + 1 > best_count) {
      best_begin = begin;
      best_count = end - begin + 1;
    }
  }
  return offsets[best_begin + best_count / 2];
}

void bind_region(config::Schema& schema, Region& region) {
  constexpr double kFar = 1e6;
  schema.add("name", region.name, "What the report calls the wall").required();
  schema.add("center", region.center, {-kFar, kFar}, "Centre of the box [m]").required();
  schema.add("size", region.size, {0.001, kFar}, "Edge lengths of the box [m]").required();
  schema.add(
      "rotation_deg", region.rotation_deg, {-360.0, 360.0}, "Roll, pitch and yaw of the box");
  schema.add("thickness", region.thickness, {0.0, 10.0}, "As measured by hand [m]; 0: unknown");
}

}  // namespace

std::vector<Region> read_regions(const std::string& path) {
  std::vector<Region> regions;
  config::Schema schema;
  schema.add_list("regions", regions, bind_region, "Boxes around walls").required();
  schema.read_file(path);
  return regions;
}

std::optional<RegionFaces> find_faces(
    const OrientedCloud& cloud, const Region& region, double max_normal_angle) {
  const std::vector<OrientedPoint> points = points_in(cloud, region);
  const Eigen::Vector3d axis = main_axis(points);
  const double min_cosine = std::cos(max_normal_angle);
  RegionFaces faces;
  for (const OrientedPoint& point : points) {
    const double cosine = point.normal.dot(axis);
    if (std::abs(cosine) >= min_cosine) {
      faces.points[cosine > 0.0 ? 0 : 1].push_back(point.position);
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (faces.points[side].empty()) {
      return std::nullopt;
    }
    const Eigen::Vector3d normal = side == 0 ? axis : Eigen::Vector3d(-axis);
    faces.planes[side] = {normal, densest_offset(faces.points[side], normal)};
  }
  return faces;
}

}  // namespace nvm::eval
