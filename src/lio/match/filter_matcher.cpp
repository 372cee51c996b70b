// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/filter_matcher.hpp"

#include "lio/match/degeneracy.hpp"

namespace nvm::lio {

FilterMatcher::FilterMatcher(
    const MeasurementOptions& measurement,
    const IterationOptions& iteration,
    const Executor& executor)
    : options_(measurement), iteration_(iteration), measurement_(measurement, executor) {
  iteration.validate();
}

MatchResult FilterMatcher::match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) {
  const NavState predicted = filter.state();
  measurement_.start(scan.scan, scan.normals, scan.keypoints, predicted);
  MatchResult result;
  const auto linearize = [&](const NavState& state, bool associate, Information& information) {
    if (associate) {
      measurement_.associate(map, state);
    }
    const bool enough = measurement_.linearize(state, information);
    result.unobserved =
        remove_unobserved(information, measurement_.mean_range(), options_.min_observability);
    return enough;
  };
  const UpdateResult update = filter.update(linearize, iteration_);
  const FitSummary fit = measurement_.summary();
  result.accepted = update.applied;
  result.iterations = update.iterations;
  result.residuals = fit.residuals;
  result.inlier_share = fit.inlier_share;
  result.residual_share = fit.residual_share;
  result.residual_rms = fit.rms;
  if (update.applied) {
    correct_deskew(predicted, filter.state(), scan.scan);
  }
  return result;
}

}  // namespace nvm::lio
