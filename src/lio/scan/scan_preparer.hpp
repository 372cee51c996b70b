// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "common/executor.hpp"
#include "lio/map/lio_map.hpp"
#include "lio/scan/keypoints.hpp"
#include "lio/scan/prepared_scan.hpp"
#include "nvm/normal/normal_estimator.hpp"

namespace nvm::lio {

/// What turns a deskewed scan into what a map takes, whoever knows its pose: odometry, or a
/// trajectory that is given. Keeps its memory from scan to scan.
class ScanPreparer {
 public:
  /// `max_plane_offset` [m]: see project_to_planes(). Throws std::invalid_argument for bad options.
  ScanPreparer(
      const NormalOptions& normals,
      double max_plane_offset,
      const KeypointOptions& keypoints,
      const Executor& executor);

  /// Estimates the normals of `prepared.scan`, moves its points onto their planes and chooses its
  /// keypoints.
  void prepare(PreparedScan& prepared);

  /// Inserts it at `T_map_lidar`; its keypoints without a plane of their own take the map's first.
  InsertStats insert(const Pose& T_map_lidar, PreparedScan& prepared, LioMap& map) const;

 private:
  NormalEstimator estimator_;
  double max_plane_offset_;
  KeypointSampler sampler_;
  Executor executor_;
};

}  // namespace nvm::lio
