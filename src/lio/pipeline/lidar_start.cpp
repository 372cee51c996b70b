// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// How LidarOdometry begins a map.
#include "lio/pipeline/lidar_odometry.hpp"

namespace nvm::lio {

void LidarOdometry::begin_map_again(const Pose& T_map_body) {
  map_->clear();
  search_->clear();
  motion_.emplace(StampedPose{predicted_.time, T_map_body});
  in_own_map_ = 0;
}

// Until the second scan nothing tells how the first one moved.
void LidarOdometry::settle_first(const Scan& scan, FrameResult& result) {
  constexpr int kRounds = 2;
  if (in_own_map_ == 1) {
    first_ = scan;
    first_pose_ = result.T_map_body;
  } else if (first_) {
    for (int i = 0; i < kRounds && is_believed(result.status) && deskew_first(result); ++i) {
      follow(scan, result);
    }
    first_.reset();
  }
}

// Begins the map again with the first scan, deskewed by the motion to the second. False at rest.
bool LidarOdometry::deskew_first(const FrameResult& second) {
  constexpr double kMinMotion = 0.01;  // [m]
  constexpr double kMinTurn = 0.005;   // [rad]
  const Pose step = first_pose_.inverse() * second.T_map_body;
  if (step.translation().norm() < kMinMotion && so3_log(step.linear()).norm() < kMinTurn) {
    return false;
  }
  const double duration = second.time - first_->t_end;
  begin_map_again(first_pose_);
  motion_.emplace(StampedPose{first_->t_end - duration, first_pose_ * step.inverse()});
  motion_->add({first_->t_end, first_pose_});
  FrameResult again;
  again.time = first_->t_end;
  follow(*first_, again);
  return is_believed(again.status);
}

}  // namespace nvm::lio
