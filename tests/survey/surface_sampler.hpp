// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "io/result/map_cloud.hpp"

namespace nvm::test {

/// What a map would have of surfaces whose truth is known.
class SurfaceSampler {
 public:
  double noise = 0.003;        ///< of points along the normal [m]
  double spacing = 0.1;        ///< of points [m]
  double normal_noise = 0.04;  ///< [rad]

  explicit SurfaceSampler(std::mt19937_64& random) : random_(random) {}

  /// Adds the rectangle from `corner` along `u` and `v`, which looks along u x v.
  void add(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    const Eigen::Vector3d n = u.cross(v).normalized();
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share;
    const double length_u = u.norm();
    const double length_v = v.norm();
    const int columns = std::max(1, static_cast<int>(length_u / spacing));
    const int rows = std::max(1, static_cast<int>(length_v / spacing));
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        const Eigen::Vector3d p = corner + (i + share(random_)) / columns * u +
                                  (j + share(random_)) / rows * v + noise * normal(random_) * n;
        const Eigen::Vector3d tilt(normal(random_), normal(random_), normal(random_));
        cloud.positions.push_back(p);
        cloud.normals.push_back((n + normal_noise * tilt).normalized().cast<float>());
      }
    }
  }

  /// Adds what another has, moved by `by`.
  void add_moved(const SurfaceSampler& other, const Eigen::Vector3d& by) {
    for (std::size_t i = 0; i < other.cloud.positions.size(); ++i) {
      cloud.positions.push_back(other.cloud.positions[i] + by);
      cloud.normals.push_back(other.cloud.normals[i]);
    }
  }

  /// Adds the four upright sides of a box, seen from outside.
  void add_box(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
    const Eigen::Vector3d size = max - min;
    const Eigen::Vector3d x(size.x(), 0, 0);
    const Eigen::Vector3d y(0, size.y(), 0);
    const Eigen::Vector3d z(0, 0, size.z());
    add(min, x, z);
    add(min + x, y, z);
    add(min + x + y, -x, z);
    add(min + y, -y, z);
  }

  /// Adds the wall between (0, 0) and `end` in plan, moved to `from`: both faces, no ends.
  void add_wall(
      const Eigen::Vector2d& from, const Eigen::Vector2d& to, double thickness, double height) {
    const Eigen::Vector3d along(to.x() - from.x(), to.y() - from.y(), 0.0);
    const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(along).normalized();
    const Eigen::Vector3d base(from.x(), from.y(), 0.0);
    const Eigen::Vector3d up(0.0, 0.0, height);
    add(base - 0.5 * thickness * across, along, up);
    add(base + along + 0.5 * thickness * across, -along, up);
  }

  io::MapCloud cloud;

 private:
  std::mt19937_64& random_;
};

}  // namespace nvm::test
