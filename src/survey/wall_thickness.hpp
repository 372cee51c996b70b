// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "survey/face.hpp"
#include "survey/pairing.hpp"
#include "survey/patch_grid.hpp"

namespace nvm::survey {

/// How the residuals of a wall's points hang together: the sums over blocks that they would vary by
/// if each point erred on its own, and that they do vary by.
struct BlockScatter {
  double expected = 0.0;
  double found = 0.0;
  double blocks = 0.0;  ///< degrees of freedom of `found`
  double common =
      0.0;  ///< covariance of the means of blocks that touch, times `common_weight` [m²]
  double common_weight = 0.0;  ///< points of such a pair, summed

  BlockScatter& operator+=(const BlockScatter& other);

  /// found / expected, drawn towards `prior` as if that came from `prior_blocks` more blocks.
  double inflation(double prior, double prior_blocks) const;

  /// Variance of what blocks that touch have in common [m²]: a shift of places half a metre apart
  /// as of one, which the number of blocks does not average out. Noise of each block for itself,
  /// as of a map's cells, is in the inflation alone.
  double sq_bend() const;
};

/// The thickness of a wall, measured where both faces are seen.
struct WallThickness {
  double value = 0.0;     ///< [m]
  double sq_noise = 0.0;  ///< variance of `value`, if each point errs on its own [m²]
  BlockScatter scatter;   ///< how far that is from true
  std::array<std::size_t, 2> points{};  ///< that were used
  std::array<double, 2> rms{};          ///< of their distances to their own face [m]
};

/// Measures the wall between two faces as `nvm evaluate` does (eval/walls/thickness.hpp): in pieces
/// of at most 3 m, so that a map that is bent along a long wall bends both its faces, off the edges
/// of what both faces show. Nothing when no piece has enough points.
std::optional<WallThickness> measure_wall(
    const SurveyCloud& cloud, const std::vector<Face>& faces, const FacePair& pair);

}  // namespace nvm::survey
