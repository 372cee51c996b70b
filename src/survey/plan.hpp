// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "survey/survey.hpp"

namespace nvm::survey {

/// A point of a floor plan: x and y of the map [m], or along the levelled axes of a tilted map.
struct PlanPoint {
  double x = 0.0;
  double y = 0.0;
};

/// A line of a floor plan, free space on its right.
struct PlanSegment {
  PlanPoint from;
  PlanPoint to;
};

/// What a wall is where the plan cuts it.
struct PlanWall {
  std::size_t wall = 0;  ///< index in Survey::walls, or in Survey::bodies
  bool is_body = false;
  std::array<std::vector<PlanSegment>, 2> faces;
  std::vector<PlanSegment> openings;  ///< on the first face
  PlanPoint label;                    ///< the middle between the longest segments
};

/// A horizontal cut through all that a survey lists.
struct Plan {
  double height = 0.0;  ///< along Survey::up [m]
  std::vector<PlanWall> walls;
  std::vector<PlanSegment> faces;  ///< single ones
  PlanPoint min;
  PlanPoint max;
};

/// The plan of `survey` at `height` [m] above its floor. What does not reach that height, or is
/// level, is not on it.
Plan make_plan(const Survey& survey, double height);

}  // namespace nvm::survey
