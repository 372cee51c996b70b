// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lio/map/lio_map.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

/// What keypoints say of a pose. One in space that the map does not know says nothing: whoever goes
/// through a door sees mostly such.
struct MapAgreement {
  std::size_t agreeing = 0;       ///< on a surface of the map
  std::size_t contradicting = 0;  ///< off the surface next to it, or seen through another one
  std::size_t unmapped = 0;

  /// Of those that say something, 0 to 1.
  double share() const {
    const std::size_t said = agreeing + contradicting;
    return said == 0 ? 0.0 : static_cast<double>(agreeing) / static_cast<double>(said);
  }
};

/// Judges a scan, `points` [m] with their unit normals (sightings are passed over) as seen by a
/// LiDAR at the origin of the scan frame, at a pose. Looks at 150 of them at most, along their
/// beams: too slow for every frame.
MapAgreement judge_agreement(
    const LioMap& map,
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Pose& T_map_scan);

/// How far points of a scan lie from the surfaces of the map at a pose: the root of their mean
/// square distance, each counted as 6 cm at most, and as 6 cm where the map knows no surface [m].
/// Of two poses, or two ways to deskew the same points, the better one has less.
double distance_from_map(
    const LioMap& map,
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<Eigen::Vector3f>& normals,
    const Pose& T_map_scan);

}  // namespace nvm::lio
