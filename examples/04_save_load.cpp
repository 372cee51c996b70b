// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Saves a map, loads it again, and shows what a damaged file gets.
#include <cstdio>
#include <fstream>
#include <nvm/nvm.hpp>

#include "thin_wall.hpp"

int main() {
  const Eigen::Vector3d origin(0, -2, 1);
  const auto scan = thin_wall::scan_from(origin);
  const nvm::NormalResult result = nvm::estimate_normals(scan, Eigen::Vector3d(0, 0, 0));
  nvm::VoxelMap map;
  map.insert(scan, result.normals, thin_wall::pose_at(origin));

  const std::string path = "example_wall.nvm";
  nvm::save_map(map, path);
  const nvm::VoxelMap loaded = nvm::load_map(path);
  std::printf("saved %zu points, loaded %zu\n", map.size(), loaded.size());

  std::ofstream(path, std::ios::app) << "not a point";
  try {
    nvm::load_map(path);
  } catch (const std::runtime_error& error) {
    std::printf("refused: %s\n", error.what());
  }
  std::remove(path.c_str());
}
