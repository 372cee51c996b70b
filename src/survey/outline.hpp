// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "survey/mask.hpp"

namespace nvm::survey {

/// A point of a plane frame [m].
struct PlanePoint {
  double u = 0.0;
  double v = 0.0;
};

/// A closed line without its first point again at the end. What it bounds lies on its left.
using Loop = std::vector<PlanePoint>;

/// The loops around `mask` along the borders of its cells: outer ones run counter-clockwise, those
/// around holes clockwise.
std::vector<Loop> trace(const Mask& mask);

/// `loop` with the points left out that are within `tolerance` [m] of the line through what is left
/// (Douglas and Peucker); at least a triangle, unless less goes in.
Loop simplified(const Loop& loop, double tolerance);

/// Area within `loop` [m²], negative when it runs clockwise.
double signed_area(const Loop& loop);

}  // namespace nvm::survey
