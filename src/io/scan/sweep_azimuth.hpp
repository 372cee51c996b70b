// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "common/sensor_data.hpp"

namespace nvm::io {

/// Where in its sweep a spinning sensor measured each point: 0 at the azimuth of the first one, 1 a
/// turn later. `points` in the order of the sensor, beams side by side or one after the other.
/// Empty when they do not go round in one direction, or less than half a turn: another kind of
/// sensor, or another order.
std::vector<float> sweep_fractions(const std::vector<TimedPoint>& points);

}  // namespace nvm::io
