// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
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
  /// Poses, of the trajectory that is not interpolated, outside the other one's time span or inside
  /// a gap of it.
  std::size_t unmatched = 0;
  std::size_t non_finite = 0;          ///< estimated poses that hold a NaN or an infinity
  double max_gap = 0.0;                ///< [s] over which was interpolated, at most
  bool interpolates_estimate = false;  ///< the truth is the sparser one
};

/// Pairs the poses of both trajectories: each pose of the sparser one with that of the other at its
/// time, interpolated (slerp and straight line) between the two poses around it unless these are
/// more than `max_gap` [s] apart, which is default_max_gap() unless it is given. Non-finite poses
/// of either take no part. Both must ascend in time.
Association associate(
    const Trajectory& estimate,
    const Trajectory& truth,
    std::optional<double> max_gap = std::nullopt);

/// Why none of the poses is paired, in one line: the spans of both, whose clocks they may be, and
/// what would bring them together.
std::string why_unmatched(const Trajectory& estimate, const Trajectory& truth);

/// "from 1000.000 to 1010.000 s (since a start)": times [s], and whose clock they may be.
std::string describe_span(double begin, double end);

}  // namespace nvm::eval
