// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "sim/motion.hpp"
#include "sim/ray_caster.hpp"

namespace nvm::sim {

/// Casts rays in all directions along the whole motion. Throws std::runtime_error, with the time,
/// the place and what is in the way, when a surface is closer than `clearance` [m] or was walked
/// through.
void check_clearance(
    const Scene& scene, const RayCaster& rays, const Motion& motion, double clearance);

}  // namespace nvm::sim
