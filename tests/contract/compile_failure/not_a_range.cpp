// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/map/voxel_map.hpp"

void insert_interleaved_coordinates(nvm::VoxelMap& map, const std::vector<double>& coordinates) {
  map.insert(coordinates, coordinates);
}
