// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// Everything that needs no optional dependency.
#include "nvm/core/executor.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/geometry/trajectory.hpp"
#include "nvm/map/kd_tree_map.hpp"
#include "nvm/map/map_concept.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/view_direction.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "nvm/registration/scan_aligner.hpp"
#include "nvm/version.hpp"
