// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/executor.hpp"
#include "io/result/session_file.hpp"
#include "lio/place/scan_witness.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::merge {

/// How a session lies in a map, and how well.
struct SessionFit {
  Pose T_map_session = Pose::Identity();
  std::size_t keyframes = 0;
  std::size_t shared_keyframes = 0;  ///< of them, that lie on the map with most of their points
  double overlap = 0.0;              ///< share of the keyframes' points on faces of the map, 0 to 1
  double contradiction = 0.0;        ///< share that the map's faces speak against, 0 to 1
  double rms = 0.0;                  ///< of the points on shared surfaces to their planes [m]
  std::string why_not;               ///< empty when the place is beyond doubt
};

/// Keyframes as one body of points, to be aligned and asked together.
class SessionBody {
 public:
  explicit SessionBody(const std::vector<io::Keyframe>& keyframes);

  /// The pose near `T_map_session` at which the points lie best on the map's planes that face them:
  /// the session moves as one rigid body.
  SessionFit aligned(
      const VoxelMap& map, const Pose& T_map_session, const Executor& executor) const;

  /// What all points say of `fit`, whose counts are filled in.
  lio::Testimonies testify(const VoxelMap& map, SessionFit& fit) const;

  const Eigen::Vector3d& center() const { return center_; }

 private:
  std::vector<Pose> T_session_lidar_;  ///< of the keyframes that are asked
  std::vector<lio::ScanWitness> witnesses_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();  ///< of the points below [m], session frame
  std::vector<Eigen::Vector3f> points_;               ///< relative to center_ [m]
  std::vector<Eigen::Vector3f> normals_;
};

}  // namespace nvm::merge
