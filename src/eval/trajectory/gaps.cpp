// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/trajectory/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "common/median.hpp"

namespace nvm::eval {

double gap_around(const Trajectory& trajectory, double time) {
  constexpr double kRounding = 1e-4;  // of times in text [s]
  const auto next = std::lower_bound(
      trajectory.begin(), trajectory.end(), time, [](const StampedPose& pose, double t) {
        return pose.time < t;
      });
  if (next == trajectory.begin() || next == trajectory.end()) {
    return 0.0;
  }
  const double before = std::prev(next)->time;
  const bool is_at_a_pose = std::min(next->time - time, time - before) <= kRounding;
  return is_at_a_pose ? 0.0 : next->time - before;
}

double usual_step(const Trajectory& trajectory) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    steps.push_back(trajectory[i].time - trajectory[i - 1].time);
  }
  return steps.empty() ? std::numeric_limits<double>::infinity() : median(std::move(steps));
}

double default_max_gap(const Trajectory& trajectory) {
  constexpr double kSteps = 1.5;
  constexpr double kMin = 0.25;
  constexpr double kMax = 1.5;
  return std::clamp(kSteps * usual_step(trajectory), kMin, kMax);
}

}  // namespace nvm::eval
