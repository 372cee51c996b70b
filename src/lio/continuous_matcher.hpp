// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lio/aligned_matcher.hpp"
#include "lio/executor.hpp"
#include "lio/scan_matcher.hpp"
#include "nvm/registration/align_options.hpp"

namespace nvm::lio {

/// CT-LIO style in continuous time (CT-ICP, Dellenbach et al. 2022): a pose at the scan's begin and
/// one at its end, each point at its own time in between.
///
/// Both poses are corrections of the IMU's motion, interpolated linearly in time, so that the fine
/// motion between them stays the IMU's. The begin is tied to where the last scan ended, as firmly
/// as the filter is sure of it.
class ContinuousMatcher final : public ScanMatcher {
 public:
  ContinuousMatcher(
      const AlignOptions& align, const PoseObservation& observation, const Executor& executor);

  MatchResult match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) override;

 private:
  using Vector12 = Eigen::Matrix<double, 12, 1, Eigen::DontAlign>;
  using Matrix12 = Eigen::Matrix<double, 12, 12, Eigen::DontAlign>;

  /// Sums over a block of keypoints: the twelve-dimensional problem, and the six-dimensional one of
  /// the end pose alone, which tells what the scan observes.
  struct Sums {
    Matrix12 information = Matrix12::Zero();
    Vector12 gradient = Vector12::Zero();
    NormalEquations end;
  };

  Sums linearize(const LioMap& map, const PreparedScan& scan, const Pose& T_world_lidar);
  /// Of the keypoint `index`, with the context and the sums of `block`.
  void add_point(
      const LioMap& map,
      const PreparedScan& scan,
      std::uint32_t index,
      const Pose& T_world_lidar,
      std::size_t block);
  void add_ties(Sums& sums) const;
  void correct_points(const Pose& T_world_lidar, DeskewedScan& scan) const;

  AlignOptions options_;
  PoseObservation observation_;
  Executor executor_;
  PoseObservation doubt_;                   ///< how unsure the prediction of the scan in work is
  float duration_ = 0.0F;                   ///< of the scan in work [s]
  Vector12 correction_ = Vector12::Zero();  ///< begin, then end: rotation (scan frame), translation
  std::vector<Sums> block_sums_;
  std::vector<LioMap::QueryContext> contexts_;
};

}  // namespace nvm::lio
