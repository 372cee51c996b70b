// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "io/map_cloud.hpp"
#include "lio/lio_map.hpp"
#include "nvm/map/map_point.hpp"

namespace nvm::app {

/// The points of a map as the writers of nvm::io take them.
io::MapCloud map_cloud_of(const std::vector<MapPoint>& points);

/// Writes map.ply and, for a voxel map, map.nvm to `folder`. Throws std::runtime_error.
void write_map_files(const lio::LioMap& map, const std::string& folder);

/// Makes `folder` unless it exists, before any work is done for it. Throws std::runtime_error when
/// it cannot be made or written to.
void make_output_folder(const std::string& folder);

}  // namespace nvm::app
