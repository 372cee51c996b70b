// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "survey/sightings.hpp"

namespace nvm::survey {

/// What keyframes tell of the poses that a map was made with: how far the same side of a wall lies
/// off itself in two of them.
class PoseEvidence {
 public:
  /// `noise`: of single points [m]; sightings that are more certain than that count alike.
  PoseEvidence(const std::vector<WallSightings>& walls, double noise);

  double sq_jitter() const { return sq_jitter_; }  ///< variance of one keyframe [m²]
  /// Variance of what a pass adds that all its keyframes share [m²]: sightings of a side that are
  /// kPassGap and more apart differ by more than those that follow each other.
  double sq_drift() const { return sq_drift_; }

  /// The variance of where `side` lies that comes from the keyframes it was seen in [m²]: the
  /// fewer, and the more they differ, the larger. What its pass adds is not in it.
  double sq_shift(const std::vector<Sighting>& side) const;

 private:
  double sq_jitter_ = 0.0;
  double sq_drift_ = 0.0;
};

/// Between two passes lie at least so many seconds in which a side was not seen.
constexpr double kPassGap = 10.0;

/// How long the sensor needed from one side of a wall to the other [s]: the least time between
/// sightings of both; infinite when a side was in no keyframe.
double time_between_sides(const WallSightings& wall);

}  // namespace nvm::survey
