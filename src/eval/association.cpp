// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/association.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nvm::eval {

namespace {

bool is_finite(const StampedPose& stamped) {
  return std::isfinite(stamped.time) && stamped.pose.matrix().allFinite();
}

Trajectory finite_poses(const Trajectory& trajectory) {
  Trajectory finite;
  std::copy_if(trajectory.begin(), trajectory.end(), std::back_inserter(finite), is_finite);
  return finite;
}

/// The time [s] between the two poses around `time`; zero at a pose and outside the span.
double gap_around(const Trajectory& trajectory, double time) {
  const auto next = std::lower_bound(
      trajectory.begin(), trajectory.end(), time, [](const StampedPose& pose, double t) {
        return pose.time < t;
      });
  if (next == trajectory.begin() || next == trajectory.end() || next->time == time) {
    return 0.0;
  }
  return next->time - std::prev(next)->time;
}

}  // namespace

Association associate(const Trajectory& estimate, const Trajectory& truth, double max_gap) {
  const Trajectory finite_truth = finite_poses(truth);
  const Trajectory finite_estimate = finite_poses(estimate);
  Association association;
  association.non_finite = estimate.size() - finite_estimate.size();
  for (const StampedPose& stamped : finite_estimate) {
    const auto T_world_body = pose_at(finite_truth, stamped.time);
    if (T_world_body && gap_around(finite_truth, stamped.time) <= max_gap) {
      association.pairs.push_back({stamped.time, stamped.pose, *T_world_body});
    } else {
      ++association.unmatched;
    }
  }
  return association;
}

}  // namespace nvm::eval
