// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/aligned_matcher.hpp"

#include <cmath>

#include "lio/match/degeneracy.hpp"
#include "lio/scan/keypoints.hpp"
#include "nvm/core/require.hpp"

namespace nvm::lio {

AlignedMatcher::AlignedMatcher(
    const AlignOptions& align, const PoseObservation& observation, const Executor& executor)
    : aligner_(align), observation_(observation), executor_(executor) {
  observation.validate();
}

MatchResult AlignedMatcher::match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) {
  pick(scan.scan.points, scan.keypoints, points_);
  pick(scan.normals, scan.keypoints, normals_);
  const AlignResult aligned =
      aligner_.align(map, points_, normals_, filter.state().T_world_lidar(), executor_);
  MatchResult result;
  result.accepted = aligned.status != AlignStatus::kTooFewResiduals;
  result.iterations = aligned.iterations;
  result.residuals = aligned.counts.valid;
  result.inlier_share = aligned.inlier_share();
  result.residual_rms = aligned.rms_distance;
  result.unobserved =
      unobserved_by(aligned, mean_range(points_), filter.state().T_body_lidar.linear());
  if (result.accepted) {
    observe_lidar_pose(aligned.T_map_scan, observation_, filter);
  }
  return result;
}

void observe_lidar_pose(
    const Pose& T_world_lidar, const PoseObservation& observation, ErrorStateFilter& filter) {
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 6, 6, Eigen::DontAlign>::Zero();
  const double translation = observation.translation_deviation;
  const double rotation = observation.rotation_deviation;
  covariance.diagonal().head<3>().setConstant(translation * translation);
  covariance.diagonal().tail<3>().setConstant(rotation * rotation);
  filter.observe_pose(T_world_lidar * filter.state().T_body_lidar.inverse(), covariance);
}

PoseObservation pose_doubt(const ErrorStateFilter& filter) {
  const auto variances = filter.covariance().diagonal();
  return {
      std::sqrt(variances.segment<3>(kPosition).maxCoeff()),
      std::sqrt(variances.segment<3>(kRotation).maxCoeff())};
}

void PoseObservation::validate() const {
  require(
      translation_deviation > 0.0, "translation_deviation", translation_deviation, "positive [m]");
  require(rotation_deviation > 0.0, "rotation_deviation", rotation_deviation, "positive [rad]");
}

}  // namespace nvm::lio
