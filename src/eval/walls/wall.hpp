// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "eval/walls/oriented_plane.hpp"

namespace nvm::eval {

/// A true face of a wall: a rectangle in the world frame.
struct WallFace {
  OrientedPlane plane;     ///< faces away from the wall
  Eigen::Vector3d center;  ///< [m]
  Eigen::Vector3d u;       ///< unit vectors along the edges
  Eigen::Vector3d v;
  double half_u = 0.0;  ///< half the length of the edges [m]
  double half_v = 0.0;
  std::size_t hits = 0;  ///< true returns on this face in the sequence
};

/// A rectangular piece of a thin wall: two faces that look away from each other.
struct WallPiece {
  std::string wall;
  int piece = 0;
  double thickness = 0.0;  ///< [m]
  std::array<WallFace, 2> faces;
};

/// The walls of a sequence's scene.json in the file's order. Throws std::runtime_error, naming the
/// file and the entry, when it is missing or malformed.
std::vector<WallPiece> read_walls(const std::string& path);

}  // namespace nvm::eval
