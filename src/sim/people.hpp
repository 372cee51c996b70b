// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <vector>

#include "sim/scene.hpp"
#include "sim/solid_intersection.hpp"

namespace nvm::sim {

/// Where `person` stands at `time` [s]: feet [m]. They start at the path's first point at time 0
/// and turn round at its ends.
Eigen::Vector3d place_of(const Person& person, double time);

/// Where a ray at `time` [s] first meets one of `people`; nobody is met from inside.
std::optional<Entry> meet_people(
    const std::vector<Person>& people,
    double time,
    const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction);

}  // namespace nvm::sim
