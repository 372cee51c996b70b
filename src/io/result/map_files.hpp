// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "io/result/map_cloud.hpp"
#include "lio/map/lio_map.hpp"
#include "nvm/map/map_point.hpp"

namespace nvm::io {

/// The points of a map that has these columns and whose origin is at `origin` [m], as the writers
/// of nvm::io take them.
MapCloud map_cloud_of(
    const std::vector<MapPoint>& points, const MapColumns& columns, const Eigen::Vector3d& origin);

/// Those of `map` that are known to lie on a surface.
MapCloud map_cloud_of(const VoxelMap& map, const Eigen::Vector3d& origin);

/// Writes `stem`.ply and, for a voxel map, `stem`.nvm, which counts from `origin` [m]. Throws
/// std::runtime_error.
void write_map_files(
    const lio::LioMap& map, const Eigen::Vector3d& origin, const std::string& stem);

}  // namespace nvm::io
