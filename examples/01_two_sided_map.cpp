// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Maps a wall of 5 cm from both sides, and asks for the neighbours of a point on its front face:
// with normals they all lie on that face, without them on both.
#include <array>
#include <cstdio>
#include <nvm/nvm.hpp>

#include "thin_wall.hpp"

int main() {
  nvm::VoxelMap map;
  nvm::NormalEstimator estimator;
  for (const Eigen::Vector3d& origin : {Eigen::Vector3d(0, -2, 1), Eigen::Vector3d(0, 2, 1)}) {
    const std::vector<thin_wall::Return> scan = thin_wall::scan_from(origin, 1);
    const nvm::NormalResult& result = estimator.estimate(scan, Eigen::Vector3d(0, 0, 0));
    map.insert(scan, result.normals, thin_wall::pose_at(origin));
  }
  std::printf("%zu points in %zu voxels, ", map.size(), map.voxel_count());
  std::printf("%zu of them with two sides\n", map.stats().two_sided_voxels);

  nvm::VoxelMap::QueryContext context;
  std::array<nvm::Neighbor, 10> neighbors;
  const nvm::NearestSearch search{neighbors.size(), 0.5};
  const Eigen::Vector3d point(0.0, thin_wall::kFrontY, 1.0);
  const auto print = [&](const char* name, std::size_t count) {
    std::printf("%s, y [mm]:", name);
    for (std::size_t i = 0; i < count; ++i) {
      std::printf(" %.0f", 1000.0 * neighbors[i].position.y());
    }
    std::printf("\n");
  };
  const Eigen::Vector3f normal(0, -1, 0);
  print("with normals   ", map.nearest(point, normal, search, neighbors.data(), context));
  print("without normals", map.nearest(point, search, neighbors.data(), context));
}
