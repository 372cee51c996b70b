// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <string>

#include "survey/sightings.hpp"

namespace nvm::survey {

/// The keyframes that `nvm run` left beside the map file `map`, moved by `origin` [m]; null when
/// there are none. Throws std::runtime_error when they are damaged or of another map.
KeyframeSource keyframes_beside(const std::string& map, const Eigen::Vector3d& origin);

}  // namespace nvm::survey
