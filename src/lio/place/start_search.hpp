// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/executor.hpp"
#include "lio/place/start_search_options.hpp"
#include "lio/scan/keypoints.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// Finds poses from which a scan can be aligned to a map when the prediction is off by more than
/// the map's own voxels reach: aligns it to a coarse map of the same scans from several poses.
class StartSearch {
 public:
  /// Throws std::invalid_argument for bad options.
  StartSearch(const StartSearchOptions& options, const Executor& executor);

  /// Adds a scan to the coarse map: points [m] and unit normals (zero: left out), scan frame.
  void insert(
      const std::vector<Eigen::Vector3f>& points,
      const std::vector<Eigen::Vector3f>& normals,
      const Pose& T_map_scan);

  /// Adds the points of `map`, which has none in common with the scans so far.
  void insert(const VoxelMap& map);

  void clear() { map_.clear(); }

  /// The poses that alignment to the coarse map finds from each of `guesses`, best fit first.
  std::vector<Pose> search(
      const std::vector<Eigen::Vector3f>& points,
      const std::vector<Eigen::Vector3f>& normals,
      const std::vector<Pose>& guesses);

  /// Each of `guesses` turned about each of the scan's axes, both ways.
  std::vector<Pose> turned(const std::vector<Pose>& guesses) const;

 private:
  StartSearchOptions options_;
  Executor executor_;
  VoxelMap map_;
  KeypointSampler sampler_;
  ScanAligner<VoxelMap> aligner_;
};

}  // namespace nvm::lio
