// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/pipeline/lidar_odometry_options.hpp"

#include <cmath>

#include "nvm/core/require.hpp"

namespace nvm::lio {

void LidarOdometryOptions::validate() const {
  returns.validate();
  normals.validate();
  keypoints.validate();
  align.validate();
  search.validate();
  require(
      min_confident_share >= 0.0 && min_confident_share <= 1.0,
      "min_confident_share",
      min_confident_share,
      "0 to 1");
  require(max_confident_motion > 0.0, "max_confident_motion", max_confident_motion, "positive [m]");
  require(
      min_inlier_share >= 0.0 && min_inlier_share <= 1.0,
      "min_inlier_share",
      min_inlier_share,
      "0 to 1");
  require(
      max_weak_duration >= 0.0 && std::isfinite(max_weak_duration),
      "max_weak_duration",
      max_weak_duration,
      "0 or more [s]");
  require(is_rigid(T_body_lidar), "T_body_lidar", "given", "a rigid transform");
}

}  // namespace nvm::lio
