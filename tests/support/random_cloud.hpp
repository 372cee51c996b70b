// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace nvm::test {

/// Points with unit normals.
struct Cloud {
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3f> normals;
};

inline Eigen::Vector3f random_unit(std::mt19937_64& rng) {
  std::normal_distribution<float> gauss;
  for (;;) {
    const Eigen::Vector3f v(gauss(rng), gauss(rng), gauss(rng));
    if (v.norm() > 1e-3F) {
      return v.normalized();
    }
  }
}

/// Uniform in a cube of edge `edge` [m] around `center`, normals in all directions.
inline Cloud uniform_cloud(
    std::size_t size, double edge, const Eigen::Vector3d& center, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> u(-0.5 * edge, 0.5 * edge);
  Cloud cloud{"uniform", {}, {}};
  for (std::size_t i = 0; i < size; ++i) {
    cloud.points.push_back(center + Eigen::Vector3d(u(rng), u(rng), u(rng)));
    cloud.normals.push_back(random_unit(rng));
  }
  return cloud;
}

/// Where thin_wall() stands: in the middle of a voxel of 0.3 m, so that both faces fall into it.
inline constexpr double kWallY = 0.16;

/// Both faces of a wall in the xz plane `thickness` thick, with 5 mm of noise: half of the points
/// on each face.
inline Cloud thin_wall(std::size_t size, double thickness, std::mt19937_64& rng) {
  std::uniform_real_distribution<double> u(-2.0, 2.0);
  std::normal_distribution<double> noise(0.0, 0.005);
  Cloud cloud{"thin wall", {}, {}};
  for (std::size_t i = 0; i < size; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    cloud.points.emplace_back(u(rng), kWallY + side * 0.5 * thickness + noise(rng), u(rng));
    const Eigen::Vector3f tilt = 0.1F * random_unit(rng);
    cloud.normals.push_back(
        (Eigen::Vector3f(0.0F, static_cast<float>(side), 0.0F) + tilt).normalized());
  }
  return cloud;
}

/// Corners of a grid of spacing `spacing` [m]: ties everywhere, points exactly on voxel faces.
inline Cloud grid_cloud(int edge, double spacing, std::mt19937_64& rng) {
  Cloud cloud{"grid", {}, {}};
  for (int x = -edge; x < edge; ++x) {
    for (int y = -edge; y < edge; ++y) {
      for (int z = -edge; z < edge; ++z) {
        cloud.points.emplace_back(x * spacing, y * spacing, z * spacing);
        cloud.normals.push_back(random_unit(rng));
      }
    }
  }
  return cloud;
}

/// The clouds that every map must answer right on.
inline std::vector<Cloud> all_clouds(std::mt19937_64& rng) {
  std::vector<Cloud> clouds;
  clouds.push_back(uniform_cloud(4000, 4.0, Eigen::Vector3d::Zero(), rng));
  clouds.push_back(uniform_cloud(2000, 3.0, {1e5, -1e5, 2e5}, rng));
  clouds.back().name = "far from the origin";
  clouds.push_back(thin_wall(4000, 0.05, rng));
  clouds.push_back(grid_cloud(6, 0.15, rng));
  clouds.push_back(uniform_cloud(1, 1.0, Eigen::Vector3d::Zero(), rng));
  clouds.back().name = "one point";
  clouds.push_back({"none", {}, {}});
  Cloud duplicates = uniform_cloud(20, 1.0, Eigen::Vector3d::Zero(), rng);
  for (std::size_t i = 0; i < 400; ++i) {
    duplicates.points.push_back(duplicates.points[i % 20]);
    duplicates.normals.push_back(duplicates.normals[i % 20]);
  }
  duplicates.name = "duplicates";
  clouds.push_back(std::move(duplicates));
  return clouds;
}

}  // namespace nvm::test
