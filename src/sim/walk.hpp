// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/motion_options.hpp"
#include "sim/scene.hpp"

namespace nvm::sim {

/// A route walked along its straight segments: the raw material that Motion makes smooth.
class Walk {
 public:
  /// The route with its laps, its waypoints moved a little by `seed`. The first step is `lead` [s]
  /// after the still time, for the smoothing to have come in.
  Walk(const Route& route, const MotionOptions& options, std::uint64_t seed, double lead);

  /// From the still start to the end of the route and a moment of rest [s].
  double duration() const;

  /// Where the feet are at `time` [s]; at the start before it, at the end after it.
  Eigen::Vector3d position(double time) const;
  /// Where the walker faces [rad]; continuous over laps, not wrapped.
  double heading(double time) const;
  /// 1 while walking, 0 while standing.
  double activity(double time) const;

 private:
  double distance(double time) const;
  std::size_t segment(double distance) const;

  double start_time_;
  double speed_;
  double speed_phase_;
  std::vector<Eigen::Vector3d> corners_;
  std::vector<double> distances_;  ///< from the start to each corner [m]
  std::vector<double> headings_;   ///< of each segment [rad]
};

}  // namespace nvm::sim
