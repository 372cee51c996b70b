// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/result/session_file.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::merge {

/// What a run left: its map, and keyframes that tell how it lies towards others.
struct Session {
  std::string name;  ///< for messages
  VoxelMap map;
  std::vector<io::Keyframe> keyframes;
  /// Of the map, in the coordinates of the run's poses [m]: zero, or in a country grid.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
};

/// Reads map.nvm and session.nvms from the results of runs; of very many keyframes some, evenly
/// spread. Throws std::runtime_error, with one line about what is wrong and what helps, for what
/// cannot be merged, and for a run that comes twice.
std::vector<Session> read_sessions(const std::vector<std::string>& folders);

}  // namespace nvm::merge
