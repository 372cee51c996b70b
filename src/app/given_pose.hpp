// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "nvm/geometry/pose.hpp"

namespace nvm::app {

/// The pose that a command line gives with `option`: x y z [m] yaw [rad] for one that is upright,
/// or x y z qx qy qz qw. Throws std::invalid_argument, naming the option, for other numbers.
Pose given_pose(const std::string& option, const std::vector<double>& numbers);

}  // namespace nvm::app
