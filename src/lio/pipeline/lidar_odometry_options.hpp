// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "lio/place/start_search_options.hpp"
#include "lio/scan/deskew.hpp"
#include "lio/scan/keypoints.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/normal/normal_options.hpp"
#include "nvm/registration/align_options.hpp"

namespace nvm::lio {

/// Configuration of a LidarOdometry.
struct LidarOdometryOptions {
  ReturnLimits returns;
  NormalOptions normals;
  KeypointOptions keypoints;
  AlignOptions align;
  StartSearchOptions search;
  /// Other starts are searched when a smaller share of the keypoints fits, 0 to 1, or when the
  /// alignment moves them by more than this [m, root mean square], positive.
  double min_confident_share = 0.8;
  double max_confident_motion = 0.3;
  /// When a smaller share fits even then, the frame is not believed, 0 to 1.
  double min_inlier_share = 0.5;
  /// The velocity holds for this long without a believed frame; then the frame counts as lost and
  /// the LiDAR is taken to stand still [s], not negative.
  double max_weak_duration = 1.0;
  Pose T_body_lidar = Pose::Identity();

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  void validate() const;
};

}  // namespace nvm::lio
