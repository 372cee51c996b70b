// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/executor.hpp"
#include "lio/match/scan_matcher.hpp"
#include "lio/match/tight_coupling.hpp"
#include "nvm/registration/align_options.hpp"

namespace nvm::lio {

/// CT-LIO style in continuous time (CT-ICP, Dellenbach et al. 2022): a pose at the scan's begin and
/// one at its end, each point at its own time in between.
///
/// Both poses are corrections of the IMU's motion, interpolated linearly in time, so that the fine
/// motion between them stays the IMU's. The begin is tied to where the last scan ended, as firmly
/// as the filter is sure of it; the end is minimised together with the IMU's prediction (tight
/// coupling), the begin being eliminated: for each end it is the one that fits best.
class ContinuousMatcher final : public ScanMatcher {
 public:
  /// See TightCoupling. Throws std::invalid_argument for bad options.
  ContinuousMatcher(const AlignOptions& align, double residual_deviation, const Executor& executor);

  MatchResult match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) override;

 private:
  /// Sums over a block of keypoints. The problem is one of both poses: what `end` says of the end
  /// alone, what this says of the begin, and how they hang together.
  struct Sums {
    NormalEquations end;
    PoseMatrix begin = PoseMatrix::Zero();
    PoseMatrix begin_end = PoseMatrix::Zero();
    PoseStep begin_gradient = PoseStep::Zero();
  };

  Sums linearize(const LioMap& map, const PreparedScan& scan, const Pose& T_world_lidar);
  /// Of the keypoint `index`, with the context and the sums of `block`.
  void add_point(
      const LioMap& map,
      const PreparedScan& scan,
      std::uint32_t index,
      const Pose& T_world_lidar,
      std::size_t block);
  /// Eliminates the begin: moves it to its best place for the end as it is, and leaves in sums.end
  /// what the matches say of the end when the begin follows it.
  void eliminate_begin(Sums& sums);
  void correct_points(const Pose& T_world_lidar, DeskewedScan& scan) const;

  AlignOptions options_;
  TightCoupling coupling_;
  double residual_variance_;  ///< [m^2]
  Executor executor_;
  // Of the scan in work. Corrections are those of the predicted motion.
  PoseStep begin_tie_;     ///< weight, in residuals
  float duration_ = 0.0F;  ///< [s]
  PoseStep begin_ = PoseStep::Zero();
  PoseStep end_ = PoseStep::Zero();
  PoseMatrix begin_per_end_ = PoseMatrix::Zero();  ///< how the begin follows the end
  std::vector<Sums> block_sums_;
  std::vector<LioMap::QueryContext> contexts_;
};

}  // namespace nvm::lio
