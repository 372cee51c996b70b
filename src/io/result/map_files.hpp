// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "io/result/map_cloud.hpp"
#include "lio/map/lio_map.hpp"
#include "nvm/map/map_point.hpp"

namespace nvm::io {

/// The points of a map whose origin is at `origin` [m], as the writers of nvm::io take them.
MapCloud map_cloud_of(const std::vector<MapPoint>& points, const Eigen::Vector3d& origin);

/// Writes `stem`.ply and, for a voxel map, `stem`.nvm, which counts from `origin` [m]. Throws
/// std::runtime_error.
void write_map_files(
    const lio::LioMap& map, const Eigen::Vector3d& origin, const std::string& stem);

}  // namespace nvm::io
