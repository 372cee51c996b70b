// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Maps a wall of 5 cm from both sides, and asks for the neighbours of a point on its front face:
// with the normal they all lie on that face, without it on both.
#include <array>
#include <cstdio>
#include <nvm/nvm.hpp>

#include "thin_wall.hpp"

int main() {
  const Eigen::Vector3d in_front(0, -2, 1), behind(0, 2, 1);

  nvm::NormalEstimator estimator;
  nvm::VoxelMap map;
  for (const Eigen::Vector3d& origin : {in_front, behind}) {
    const std::vector<thin_wall::Return> scan = thin_wall::scan_from(origin);  // x, y, z
    const nvm::NormalResult& result = estimator.estimate(scan, Eigen::Vector3d(0, 0, 0));
    map.insert(scan, result.normals, thin_wall::pose_at(origin));
  }
  const Eigen::Vector3d point(0, thin_wall::kFrontY, 1);
  const Eigen::Vector3f normal(0, -1, 0);
  nvm::VoxelMap::QueryContext context;  // one per thread
  std::array<nvm::Neighbor, 10> neighbors;
  std::size_t count = map.nearest(point, normal, {10, 0.5}, neighbors.data(), context);

  const auto print = [&](const char* name) {
    std::printf("%s, y [mm]:", name);
    for (std::size_t i = 0; i < count; ++i) {
      std::printf(" %.0f", 1000.0 * neighbors[i].position.y());
    }
    std::printf("\n");
  };
  print("with the normal   ");
  count = map.nearest(point, {10, 0.5}, neighbors.data(), context);
  print("without the normal");
  std::printf("%zu points in %zu voxels, ", map.size(), map.voxel_count());
  std::printf("%zu of them with two sides\n", map.stats().two_sided_voxels);
}
