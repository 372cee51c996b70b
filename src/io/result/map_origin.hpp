// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <string>

#include "nvm/geometry/trajectory.hpp"

namespace nvm::io {

/// Where a map that is built from `poses` should have its origin [m]: at zero, or near the first
/// pose, in whole hundreds of metres, when that is too far away for the map, as in UTM.
Eigen::Vector3d choose_origin(const Trajectory& poses);

/// `trajectory` with all positions moved by `offset` [m].
Trajectory moved(Trajectory trajectory, const Eigen::Vector3d& offset);

/// Writes `origin` beside the map file `map`: to map_origin.txt for map.nvm. Throws
/// std::runtime_error.
void write_origin(const std::string& map, const Eigen::Vector3d& origin);

/// Writes `origin` beside `pending`, a file that will be moved to `map`, unless what lies beside
/// `map` tells it already. Throws std::runtime_error.
void write_origin_unless_told(
    const std::string& map, const Eigen::Vector3d& origin, const std::string& pending);

/// The origin [m] that was written beside the map file `map`, or else beside a map.nvm there, which
/// may have been renamed; zero when there is none. Throws std::runtime_error when the file is
/// malformed.
Eigen::Vector3d read_origin(const std::string& map);

}  // namespace nvm::io
