// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>

#include "eval/walls/wall.hpp"
#include "eval/walls/wall_points.hpp"

namespace nvm::eval {

/// How many of a wall's points carry the normal of the face that they do not come from.
struct SideCount {
  std::size_t points = 0;
  double wrong = 0.0;  ///< an unbiased estimate: it may fall below zero by chance

  SideCount& operator+=(const SideCount& other) {
    points += other.points;
    wrong += other.wrong;
    return *this;
  }

  /// Share of the points with the right side, 0 to 1; nothing without points.
  std::optional<double> purity() const;
};

/// Counts the points of `wall` on the wrong side, its `points` being told apart by their normals.
///
/// Where noise is as large as the wall is thin, a position cannot tell which face a point came
/// from. But a point that carries face A and lies *beyond face B* is at least a thickness off its
/// own face, and half of the points that come from B lie beyond B. So wrong = 2 (beyond -
/// mirrored), where "mirrored" counts the points as far off in front of A: what symmetric noise
/// alone puts there. The true faces are moved along the normal to the middle of the mapped wall
/// first.
SideCount count_sides(const SidedPoints& points, const WallPiece& wall);

}  // namespace nvm::eval
