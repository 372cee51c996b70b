// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "sim/scene.hpp"

namespace nvm::sim {

/// Reads the triangles of a PLY, OBJ or STL file; vertices as written, scaled by `scale`, then
/// placed by `T_world_mesh`. Throws std::runtime_error, naming `path`, when it cannot be read or
/// has no triangles.
Mesh read_mesh(const std::string& path, double scale, const Pose& T_world_mesh);

}  // namespace nvm::sim
