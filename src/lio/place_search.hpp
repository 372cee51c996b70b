// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lio/executor.hpp"
#include "lio/keypoints.hpp"
#include "lio/outline.hpp"
#include "lio/start_search.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// Where in a map a scan was made.
struct Place {
  Pose T_map_scan = Pose::Identity();
  double share = 0.0;       ///< of the scan that lies on surfaces of the map that face it, 0 to 1
  double cost = 1.0;        ///< how far off the scan lies there, see AlignResult
  int open_directions = 0;  ///< of the pose's six, that the scan does not tell
  std::string why_not;      ///< empty when the place is beyond doubt

  bool is_found() const { return why_not.empty(); }
};

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

  /// The place anywhere in the map, which is level, as the scan's `up` (unit, scan frame) makes the
  /// scan. Not found when two places explain the scan about equally well.
  Place anywhere(
      const std::vector<Eigen::Vector3f>& points,
      const std::vector<Eigen::Vector3f>& normals,
      const Eigen::Vector3d& up);

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
