// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "lio/match/scan_matcher.hpp"
#include "lio/state/error_state_filter.hpp"
#include "nvm/registration/align_options.hpp"
#include "nvm/registration/normal_equations.hpp"

namespace nvm::lio {

/// From what a scan's matches say of the LiDAR's pose to the update of the filter, so that they are
/// minimised together with the IMU's prediction and its covariance.
class TightCoupling {
 public:
  /// `residual_deviation`: of a point from its plane [m], positive, those that share map points
  /// counted as one. Throws std::invalid_argument for bad options.
  TightCoupling(const AlignOptions& align, double residual_deviation);

  /// Turns `equations`, linearised over the LiDAR's pose at `state`, into information on the state,
  /// without the directions that the scan does not tell, and says in `result` how well it fits.
  /// False when too little does.
  bool inform(
      const NormalEquations& equations,
      const NavState& state,
      Information& information,
      MatchResult& result) const;

  /// How often, and until when, the filter is to look again. Each time all points are associated
  /// anew: what a residual says changes with its plane.
  const IterationOptions& iteration() const { return iteration_; }

 private:
  std::size_t min_residuals_;
  double min_observability_;
  double residual_deviation_;
  IterationOptions iteration_;
};

}  // namespace nvm::lio
