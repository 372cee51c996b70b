// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/geometry/trajectory.hpp"

namespace nvm::eval {

/// The time [s] between the two poses around `time`; zero at a pose and outside the span.
double gap_around(const Trajectory& trajectory, double time);

/// The median time [s] between poses; infinite when there are fewer than two.
double usual_step(const Trajectory& trajectory);

/// Over how long a gap [s] `trajectory` may be interpolated: one and a half usual steps, 0.25 s at
/// least and 1.5 s at most.
double default_max_gap(const Trajectory& trajectory);

}  // namespace nvm::eval
