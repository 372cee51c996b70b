// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "io/result/map_cloud.hpp"

namespace nvm::io {

/// Reads the points of all tiles of a store (docs/living_maps.md, "The format, version 1"), each
/// once: those that a tile has of its neighbours are left out. Throws std::runtime_error, naming
/// the file, for anything that is no store, or damaged.
MapCloud read_tile_store(const std::string& folder);

}  // namespace nvm::io
