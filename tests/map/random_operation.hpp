// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "nvm/map/voxel_map.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm::test {

using Rng = std::mt19937_64;
inline MapOptions random_options(Rng& rng) {
  const auto one_of = [&](auto... values) {
    const std::array all{values...};
    return all[rng() % all.size()];
  };
  MapOptions options;
  options.voxel_size = one_of(0.01, 0.3, 1.0 / 3.0, 7.0);
  options.capacity = one_of(std::size_t{1}, std::size_t{2}, std::size_t{60}, std::size_t{100'000});
  options.max_bytes = one_of(std::size_t{0}, std::size_t{0}, MapOptions::kMinBytes);
  options.points_per_surface = one_of(1, 5, 8, 20, 120);
  options.min_point_distance = options.voxel_size * one_of(0.0, 0.05, 0.3, 1.0, 2.0);
  options.space_across_voxels = one_of(false, true);
  options.max_merged_points = one_of(1, 1, 2, 255);
  options.max_surfaces = one_of(1, 2, 8);
  options.surface_rule = one_of(SurfaceRule::kPaper, SurfaceRule::kSmallestAngle);
  options.max_surface_angle = one_of(0.0, 0.5, 1.5707963267948966, 3.141592653589793);
  options.max_point_angle = one_of(0.1, 1.7453292519943295);
  options.columns.intensity = one_of(false, true);
  return options;
}

/// Does the same to any two maps: scans, hairs beside the borders of voxels,
/// erasures, queries.
class RandomOperation {
 public:
  RandomOperation(const MapOptions& options, Rng& rng)
      : kind_(rng() % 12), edge_(options.voxel_size), seed_(rng()) {}

  void operator()(VoxelMap& map) const {
    Rng rng(seed_);
    const Eigen::Vector3d center =
        10.0 * edge_ * random_unit(rng).cast<double>() + Eigen::Vector3d::Constant(offset(rng));
    if (kind_ < 6) {
      Cloud cloud = uniform_cloud(rng() % 400, 8.0 * edge_, center, rng);
      put_on_borders(cloud, rng);
      map.insert(cloud.points, cloud.normals);
    } else if (kind_ == 6) {
      map.insert_unsided(uniform_cloud(30, 3.0 * edge_, center, rng).points);
    } else if (kind_ == 7) {
      const Eigen::Vector3d reach = Eigen::Vector3d::Constant(1.5 * edge_);
      map.erase_box(center - reach, center + reach);
    } else if (kind_ == 8) {
      map.erase_within(center, 2.0 * edge_);
    } else if (kind_ == 9) {
      map.erase_voxels_beyond(center, 12.0 * edge_);
    } else {
      ask(map, center, rng);
    }
  }

 private:
  static double offset(Rng& rng) { return rng() % 4 == 0 ? 1000.0 : 0.0; }

  void put_on_borders(Cloud& cloud, Rng& rng) const {
    for (std::size_t i = 0; i < cloud.points.size(); i += 3) {
      double& x = cloud.points[i][static_cast<Eigen::Index>(rng() % 3)];
      const double border = std::round(x / edge_) * edge_;
      const double hair = rng() % 2 == 0 ? 1e-17 : std::abs(border) * 1e-16;
      x = rng() % 2 == 0 ? border - hair : border + hair;
    }
  }

  static void ask(VoxelMap& map, const Eigen::Vector3d& center, Rng& rng) {
    VoxelMap::QueryContext context;
    std::array<Neighbor, 20> found;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d point = center + 0.1 * i * Eigen::Vector3d::UnitX();
      map.nearest(point, random_unit(rng), {20, 1.0}, found.data(), context);
    }
  }

  std::uint64_t kind_;
  double edge_;
  std::uint64_t seed_;
};

}  // namespace nvm::test
