// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/registration/association.hpp"
#include "nvm/registration/normal_equations.hpp"
#include "nvm/registration/robust_kernel.hpp"

namespace nvm {

/// Configuration of a ScanAligner.
struct AlignOptions {
  AssociationOptions association;
  RobustKernel kernel;
  /// Gauss-Newton steps at most, 1 to 1000.
  int max_iterations = 20;
  /// A step that turns by less [rad] and moves by less [m] ends the iteration; not negative.
  double converged_rotation = 1e-4;
  double converged_translation = 1e-3;
  /// Fewer associated points than this are no basis for a pose, at least 6.
  std::size_t min_residuals = 50;
  /// Directions with less information per unit of weight keep the guess, 0 to 1 (PoseSolution).
  double min_observability = 1e-3;

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  NVM_SHARED void validate() const;
};

enum class AlignStatus : std::uint8_t {
  kConverged,
  kMaxIterations,    ///< the pose is the last iterate
  kTooFewResiduals,  ///< the pose is the guess
};

/// Outcome of an alignment. All but the pose describe the last linearisation, made one step before
/// `T_map_scan`.
struct AlignResult {
  Pose T_map_scan = detail::identity();
  AlignStatus status = AlignStatus::kTooFewResiduals;
  int iterations = 0;
  AssociationCounts counts;
  double rms_distance = 0.0;  ///< of the associated points to their planes [m]
  /// Mean over all points of (distance / max_plane_distance)^2, 1 for those without a plane: 0
  /// (perfect) to 1 (nothing fits). Ranks poses of one scan.
  double cost = 1.0;
  /// Weighted information of the pose (sum w J J^T over a PoseStep) [1/m^2 per residual of 1 m].
  PoseMatrix information = detail::zeros<PoseMatrix>();
  std::array<double, 6> observability{};  ///< ascending, see PoseSolution
  int degenerate_directions = 0;          ///< 6 minus the rank of what the scan tells

  /// Share of the scan's points that found their plane, 0 to 1.
  NVM_SHARED double inlier_share() const {
    const std::size_t total = counts.total();
    return total == 0 ? 0.0 : static_cast<double>(counts.valid) / static_cast<double>(total);
  }
};

inline void AlignOptions::validate() const {
  association.validate();
  kernel.validate();
  require(
      max_iterations >= 1 && max_iterations <= 1000, "max_iterations", max_iterations, "1 to 1000");
  require(
      converged_rotation >= 0.0, "converged_rotation", converged_rotation, "zero or more [rad]");
  require(
      converged_translation >= 0.0,
      "converged_translation",
      converged_translation,
      "zero or more [m]");
  require(min_residuals >= 6, "min_residuals", min_residuals, "6 or more");
  require(
      min_observability >= 0.0 && min_observability <= 1.0,
      "min_observability",
      min_observability,
      "0 to 1");
}

}  // namespace nvm
