// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "common/executor.hpp"
#include "lio/match/pose_observation.hpp"
#include "lio/match/scan_matcher.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// CT-LIO style: the scan, deskewed by the IMU, is aligned to the map by robust, planarity-weighted
/// least squares on its own; the filter then takes the pose as an observation (loose coupling).
class AlignedMatcher final : public ScanMatcher {
 public:
  AlignedMatcher(
      const AlignOptions& align, const PoseObservation& observation, const Executor& executor);

  MatchResult match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) override;

 private:
  ScanAligner<LioMap> aligner_;
  PoseObservation observation_;
  Executor executor_;
  std::vector<Eigen::Vector3f> points_, normals_;
};

/// Feeds `T_world_lidar`, the pose that an optimisation found, back into the filter.
void observe_lidar_pose(
    const Pose& T_world_lidar, const PoseObservation& observation, ErrorStateFilter& filter);

/// How unsure `filter` is of the body's pose: one standard deviation.
PoseObservation pose_doubt(const ErrorStateFilter& filter);

}  // namespace nvm::lio
