// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

namespace nvm::sim {

/// Throws std::runtime_error, naming the file, for a PLY that is cut off or whose faces have
/// corners that it lacks: assimp would read beyond its memory.
void check_ply(const std::string& path);

}  // namespace nvm::sim
