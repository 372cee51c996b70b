// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <vector>

#include "nvm/geometry/trajectory.hpp"

namespace nvm::eval {

/// An estimated pose and the true one at the same time. "body" is the frame whose pose both
/// trajectories tell: the IMU's in nvm's own sequences.
struct PosePair {
  double time = 0.0;  ///< [s]
  Pose T_map_body = Pose::Identity();
  Pose T_world_body = Pose::Identity();
};

/// An estimate brought together with the truth.
struct Association {
  std::vector<PosePair> pairs;  ///< ascending in time
  std::size_t unmatched = 0;    ///< poses outside the truth's time span, or inside a gap of it
  std::size_t non_finite = 0;   ///< poses that hold a NaN or an infinity
};

/// Pairs each pose of `estimate` with the true pose at its time, interpolated (slerp and straight
/// line) between the two poses of `truth` around it unless these are more than `max_gap` [s] apart.
/// Non-finite poses of either trajectory take no part. Both must ascend in time.
Association associate(const Trajectory& estimate, const Trajectory& truth, double max_gap = 0.25);

}  // namespace nvm::eval
