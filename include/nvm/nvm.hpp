// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// Everything that needs no optional dependency.
#include "nvm/core/executor.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/insert_stats.hpp"
#include "nvm/map/map_concept.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/version.hpp"
