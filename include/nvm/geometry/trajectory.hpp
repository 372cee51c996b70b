// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm {

/// A pose and its time [s].
struct StampedPose {
  double time = 0.0;
  Pose pose = detail::identity();
};

/// Poses in ascending order of time.
using Trajectory = std::vector<StampedPose>;

inline namespace NVM_TARGET {

/// The pose a share `alpha` (0 to 1) of the way from `a` to `b`: slerp for the rotation, a straight
/// line for the position. `Transform`: Pose, or Eigen::Isometry3d.
template <class Transform>
Transform interpolate(const Transform& a, const Transform& b, double alpha) {
  using Quaternion = Eigen::Quaternion<typename Transform::Scalar>;
  const Quaternion q = Quaternion(a.linear()).slerp(alpha, Quaternion(b.linear()));
  Transform pose = Transform::Identity();
  pose.linear() = q.toRotationMatrix();
  pose.translation() = (1.0 - alpha) * a.translation() + alpha * b.translation();
  return pose;
}

/// The pose of `trajectory`, or any such range, at `time` [s], interpolated; nothing outside its
/// time span.
template <class Poses, class Transform = Pose>
std::optional<Transform> pose_at(const Poses& trajectory, double time) {
  const auto next = std::lower_bound(
      trajectory.begin(), trajectory.end(), time, [](const StampedPose& pose, double t) {
        return pose.time < t;
      });
  if (next == trajectory.end()) {
    return std::nullopt;
  }
  if (next->time == time) {
    return next->pose;
  }
  if (next == trajectory.begin()) {
    return std::nullopt;
  }
  const StampedPose& previous = *(next - 1);
  return interpolate(
      previous.pose, next->pose, (time - previous.time) / (next->time - previous.time));
}

}  // namespace NVM_TARGET
}  // namespace nvm
