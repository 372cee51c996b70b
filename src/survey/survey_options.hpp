// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace nvm::survey {

/// How walls are looked for. Lengths in metres, angles in radians.
struct SurveyOptions {
  double patch_size = 0.25;     ///< edge of the cells that faces grow over, 0.05 to 2; grows by
                                ///< itself where the map is too sparse for it
  double min_area = 0.6;        ///< seen from both sides [m²], 0.1 to 100; smaller pairs are left
  double max_thickness = 0.6;   ///< farther faces are no pair, 0.05 to 2
  double min_thickness = 0.01;  ///< nearer faces are no pair, 0 to 0.1
  double max_gap = 1.6;         ///< in-plane gap that a face is joined across, 0 to 20
  double plan_height = 1.2;     ///< of the plan above the lowest floor, -100 to 100
  double drift = 0.0;           ///< standard deviation of the pose between two passes [m], 0 to 1

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  void validate() const;
};

}  // namespace nvm::survey
