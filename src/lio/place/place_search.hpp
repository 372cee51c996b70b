// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/executor.hpp"
#include "lio/place/outline.hpp"
#include "lio/place/place.hpp"
#include "lio/place/start_search.hpp"
#include "lio/scan/keypoints.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// Finds the place in a map where a scan was made. Sides count: a wall seen from one room never
/// fits its other face. Uses `map` while it lives, and never changes it.
class PlaceSearch {
 public:
  PlaceSearch(const VoxelMap& map, const Executor& executor);

  /// The place within about 1 m and 20 degrees of `T_map_scan`. The scan: points [m] and unit
  /// normals (zero: left out) of equal number.
  Place near(
      const std::vector<Eigen::Vector3f>& points,
      const std::vector<Eigen::Vector3f>& normals,
      const Pose& T_map_scan);

  /// Places anywhere in the map, which is level, as the scan's `up` (unit, scan frame) makes the
  /// scan: those that most of it fits, best first and no two the same. Places around a `likely`
  /// T_map_scan are among those that are tried.
  std::vector<Place> candidates(
      const std::vector<Eigen::Vector3f>& points,
      const std::vector<Eigen::Vector3f>& normals,
      const Eigen::Vector3d& up,
      const std::optional<Pose>& likely = std::nullopt);

  /// The one of these that is beyond doubt. Not found when two explain the scan about equally well.
  Place anywhere(
      const std::vector<Eigen::Vector3f>& points,
      const std::vector<Eigen::Vector3f>& normals,
      const Eigen::Vector3d& up,
      const std::optional<Pose>& likely = std::nullopt);

 private:
  bool choose_keypoints(
      const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals);
  Place refined(const Pose& T_map_scan);
  std::vector<Place> places_from(const std::vector<Pose>& guesses);
  std::vector<Pose> guesses_for(const Eigen::Matrix3d& R_level_scan) const;

  const VoxelMap& map_;
  Executor executor_;
  KeypointSampler sampler_;
  StartSearch coarse_;
  Outline outline_;
  ScanAligner<VoxelMap> aligner_;
  std::vector<Eigen::Vector3f> key_points_, key_normals_;
};

}  // namespace nvm::lio
