// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/tight_coupling.hpp"

#include <cmath>

#include "lio/match/degeneracy.hpp"
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

TightCoupling::TightCoupling(const AlignOptions& align, double residual_deviation)
    : min_residuals_((align.validate(), align.min_residuals)),
      min_observability_(align.min_observability),
      residual_deviation_(residual_deviation) {
  require(
      residual_deviation > 0.0 && std::isfinite(residual_deviation),
      "residual_deviation",
      residual_deviation,
      "positive [m]");
  iteration_ = {align.max_iterations, align.converged_translation, align.converged_rotation};
}

bool TightCoupling::inform(
    const NormalEquations& equations,
    const NavState& state,
    Information& information,
    MatchResult& result) const {
  const std::size_t total = equations.counts.total();
  result.residuals = equations.counts.valid;
  result.inlier_share =
      total == 0 ? 0.0 : static_cast<double>(equations.counts.valid) / static_cast<double>(total);
  result.residual_rms = equations.rms_distance();
  const Projection J = lidar_step(state);
  const double weight = 1.0 / (residual_deviation_ * residual_deviation_);
  information.matrix = weight * (J.transpose() * equations.information * J);
  information.vector = weight * (J.transpose() * equations.gradient);
  const double mean_range = equations.sum_weights > 0.0
                                ? std::sqrt(equations.sum_sq_ranges / equations.sum_weights)
                                : 0.0;
  result.unobserved = remove_unobserved(information, mean_range, min_observability_);
  return equations.counts.valid >= min_residuals_;
}

}  // namespace nvm::lio
