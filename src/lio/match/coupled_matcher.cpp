// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/coupled_matcher.hpp"

#include "lio/scan/keypoints.hpp"

namespace nvm::lio {

CoupledMatcher::CoupledMatcher(
    const AlignOptions& align, double residual_deviation, const Executor& executor)
    : aligner_(align), coupling_(align, residual_deviation), executor_(executor) {}

MatchResult CoupledMatcher::match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) {
  pick(scan.scan.points, scan.keypoints, points_);
  pick(scan.normals, scan.keypoints, normals_);
  MatchResult result;
  const auto linearize = [&](const NavState& state, bool, Information& information) {
    const NormalEquations equations =
        aligner_.linearize(map, points_, normals_, state.T_world_lidar(), executor_);
    return coupling_.inform(equations, state, information, result);
  };
  const UpdateResult update = filter.update(linearize, coupling_.iteration());
  result.accepted = update.applied;
  result.iterations = update.iterations;
  return result;
}

}  // namespace nvm::lio
