// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "lio/state/constant_velocity.hpp"
#include "lio/state/motion_segment.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::lio {

/// The motion from `begin` to `end` [s] along known poses, those in between included, as pieces
/// short enough for deskew(), into `pieces`. Before the first pose it stands there; `end` must not
/// be after the last.
inline void motion_along(
    const Trajectory& T_map_body, double begin, double end, std::vector<MotionSegment>& pieces) {
  constexpr int kPieces = 10;
  const auto at = [&](double time) {
    return StampedPose{time, pose_at(T_map_body, time).value_or(T_map_body.front().pose)};
  };
  pieces.clear();
  if (!(begin < end)) {
    pieces.push_back(ConstantVelocity(at(end)).at(end, 0.0));
    return;
  }
  StampedPose from = at(begin);
  for (int i = 1; i <= kPieces; ++i) {
    const StampedPose to = at(i < kPieces ? begin + i * (end - begin) / kPieces : end);
    ConstantVelocity motion(from);
    motion.add(to);
    pieces.push_back(motion.at(from.time, 0.0));
    from = to;
  }
}

}  // namespace nvm::lio
