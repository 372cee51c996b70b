// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lio/map/lio_map.hpp"
#include "lio/state/weighted_mean.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

/// Keypoints of a deskewed scan, by the arrays that hold them.
struct DeskewedKeypoints {
  const std::vector<Eigen::Vector3f>& points;   ///< [m], scan frame
  const std::vector<Eigen::Vector3f>& normals;  ///< unit or sighting, scan frame
  const std::vector<float>& ages;               ///< scan's end - time of the point [s]
};

/// How a frame moves during a sweep, by its own axes.
struct SweepMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();      ///< [rad/s]
};

/// Notices point times that are not those of the points. A scan fits the map best when each point
/// is moved by some share of what deskewing did: by 1 if its time is right, 0 if a driver had
/// deskewed the scan already, 2 if the times say half of what they should, -1 if they run
/// backwards.
class DeskewWatch {
 public:
  /// Takes a scan before it enters `map`, in which its LiDAR was found at T_map_body *
  /// T_body_lidar, while the body moved by `motion`. One that hardly turns says nothing, nor do
  /// more than a hundred.
  void add(
      const LioMap& map,
      const DeskewedKeypoints& keypoints,
      const Pose& T_map_body,
      const Pose& T_body_lidar,
      const SweepMotion& motion);

  /// One line, once the share is clearly another; "" before.
  std::string finding() const;

 private:
  WeightedMean share_;  ///< of the scans
};

}  // namespace nvm::lio
