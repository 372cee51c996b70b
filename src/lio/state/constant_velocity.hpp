// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "lio/state/motion_segment.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::lio {

/// Predicts a motion without an IMU: it goes on as between the last two poses.
class ConstantVelocity {
 public:
  /// `first`: where the motion starts, at rest.
  explicit ConstantVelocity(const StampedPose& first) : last_(first) {}

  const StampedPose& last() const { return last_; }
  const Eigen::Vector3d& velocity() const { return velocity_; }  ///< [m/s], world
  const Eigen::Vector3d& rate() const { return rate_; }          ///< [rad/s], body

  /// Takes the next pose; its time is later than the last one's.
  void add(const StampedPose& pose) {
    const double duration = pose.time - last_.time;
    rate_ = so3_log(last_.pose.linear().transpose() * pose.pose.linear()) / duration;
    velocity_ = (pose.pose.translation() - last_.pose.translation()) / duration;
    last_ = pose;
  }

  /// The motion at `time` [s], predicted over at most `horizon` [s]: it stands still from then on.
  MotionSegment at(double time, double horizon) const {
    MotionSegment segment{last_.time, last_.pose, velocity_, rate_};
    segment.T_world_body = segment.pose_at(std::min(time, last_.time + horizon));
    segment.time = time;
    return segment;
  }

  /// The motion from `begin` to `end` [s] as pieces short enough for deskew(), into `pieces`.
  void sweep(double begin, double end, double horizon, std::vector<MotionSegment>& pieces) const {
    const int count = end > begin ? 10 : 1;
    pieces.clear();
    for (int i = 0; i < count; ++i) {
      pieces.push_back(at(begin + i * (end - begin) / count, horizon));
    }
  }

 private:
  StampedPose last_;
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();      // [rad/s], body
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // [m/s], world
};

}  // namespace nvm::lio
