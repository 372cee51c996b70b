// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "eval/evaluation.hpp"

namespace nvm::eval {

/// A picture of one wall.
struct WallPicture {
  std::string name;
  std::string svg;  ///< cross-sections of the wall, one run beside the other
};

/// Cross-sections of the regions and of the walls that were seen: of all of them, or of the
/// `max_walls` whose worst error over all runs is largest (a wall that a map lacks being worst).
/// Points are coloured by the face that their normals tell, grey in maps without normals; lines
/// are the true faces.
std::vector<WallPicture> wall_pictures(const Evaluation& evaluation, std::size_t max_walls = 12);

}  // namespace nvm::eval
