// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/coupled_matcher.hpp"

#include <cmath>

#include "lio/degeneracy.hpp"
#include "lio/keypoints.hpp"
#include "nvm/core/require.hpp"

namespace nvm::lio {

namespace {

using Projection = Eigen::Matrix<double, 6, kMeasuredSize, Eigen::DontAlign>;

/// From a change of the state to that of the LiDAR's pose: a PoseStep, rotation first.
Projection lidar_step(const NavState& state) {
  Projection J = Projection::Zero();
  J.block<3, 3>(0, kRotation) = state.T_body_lidar.linear().transpose();
  J.block<3, 3>(3, kPosition) = Eigen::Matrix3d::Identity();
  J.block<3, 3>(3, kRotation) =
      -state.T_world_body.linear() * skew(state.T_body_lidar.translation());
  return J;
}

}  // namespace

CoupledMatcher::CoupledMatcher(
    const AlignOptions& align, double residual_deviation, const Executor& executor)
    : aligner_(align), residual_deviation_(residual_deviation), executor_(executor) {
  require(
      residual_deviation > 0.0 && std::isfinite(residual_deviation),
      "residual_deviation",
      residual_deviation,
      "positive [m]");
}

MatchResult CoupledMatcher::match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) {
  pick(scan.scan.points, scan.keypoints, points_);
  pick(scan.normals, scan.keypoints, normals_);
  // What a residual says changes with its plane: each iteration associates anew.
  const auto linearize_at = [&](const NavState& state, bool, Information& out) {
    return linearize(map, state, out);
  };
  IterationOptions iteration;
  iteration.max_iterations = aligner_.options().max_iterations;
  const UpdateResult update = filter.update(linearize_at, iteration);
  result_.accepted = update.applied;
  result_.iterations = update.iterations;
  return result_;
}

bool CoupledMatcher::linearize(const LioMap& map, const NavState& state, Information& out) {
  const NormalEquations equations =
      aligner_.linearize(map, points_, normals_, state.T_world_lidar(), executor_);
  const std::size_t total = equations.counts.total();
  result_.residuals = equations.counts.valid;
  result_.inlier_share =
      total == 0 ? 0.0 : static_cast<double>(equations.counts.valid) / static_cast<double>(total);
  result_.residual_rms = equations.rms_distance();
  const Projection J = lidar_step(state);
  const double information = 1.0 / (residual_deviation_ * residual_deviation_);
  out.matrix = information * (J.transpose() * equations.information * J);
  out.vector = information * (J.transpose() * equations.gradient);
  const double mean_range = equations.sum_weights > 0.0
                                ? std::sqrt(equations.sum_sq_ranges / equations.sum_weights)
                                : 0.0;
  result_.degenerate_directions =
      remove_unobserved(out, mean_range, aligner_.options().min_observability);
  return equations.counts.valid >= aligner_.options().min_residuals;
}

}  // namespace nvm::lio
