// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Aligns a scan to a map from a guess that is 8 cm off. Any class that models the map concept
// (map_concept.hpp) can stand in for VoxelMap, your own too: here the k-d tree of bare points.
#include <cstdio>
#include <nvm/nvm.hpp>

#include "thin_wall.hpp"

namespace {

const Eigen::Vector3d kViewpoint = Eigen::Vector3d::Zero();

template <class Map>
void align(const char* name, const Map& map) {
  const Eigen::Vector3d origin(0.3, -1.8, 1.1);
  const auto scan = thin_wall::scan_from(origin);
  const nvm::NormalResult normals = nvm::estimate_normals(scan, kViewpoint);

  nvm::ScanAligner<Map> aligner;
  const nvm::Pose T_guess = thin_wall::pose_at(origin + Eigen::Vector3d(0.0, 0.06, 0.05));
  const nvm::AlignResult result = aligner.align(map, scan, normals.normals, T_guess);

  // Along the wall nothing holds the sensor: that direction keeps its guess, and is reported.
  const Eigen::Vector3d error = result.T_map_scan.translation() - origin;
  std::printf("%-10s %5.1f mm off across the wall, ", name, 1000.0 * std::abs(error.y()));
  std::printf("%d iterations, ", result.iterations);
  std::printf("%d direction(s) left to the guess\n", result.degenerate_directions);
}

}  // namespace

int main() {
  nvm::VoxelMap voxel_map;
  nvm::KdTreeMap kd_tree_map;
  for (const Eigen::Vector3d& origin : {Eigen::Vector3d(0, -2, 1), Eigen::Vector3d(0, 2, 1)}) {
    const auto scan = thin_wall::scan_from(origin);
    const nvm::NormalResult normals = nvm::estimate_normals(scan, kViewpoint);
    voxel_map.insert(scan, normals.normals, thin_wall::pose_at(origin));
    kd_tree_map.insert_unsided(scan, thin_wall::pose_at(origin));
  }
  align("VoxelMap", voxel_map);
  align("KdTreeMap", kd_tree_map);
}
