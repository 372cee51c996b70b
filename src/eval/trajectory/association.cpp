// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/trajectory/association.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "eval/trajectory/gaps.hpp"

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

/// Whose clock shows `time` [s], as far as that can be told.
std::string clock_of(double time) {
  constexpr double kUnix = 1e9;  // 2001
  struct Unit {
    double seconds;
    const char* meaning;
  };
  constexpr std::array<Unit, 4> kUnits = {
      {{1e-9, "UNIX time in nanoseconds? TUM files have seconds"},
       {1e-6, "UNIX time in microseconds? TUM files have seconds"},
       {1e-3, "UNIX time in milliseconds? TUM files have seconds"},
       {1.0, "UNIX time"}}};
  for (const Unit& unit : kUnits) {
    if (time * unit.seconds >= kUnix) {
      return unit.meaning;
    }
  }
  return "since a start";
}

}  // namespace

Association associate(
    const Trajectory& estimate, const Trajectory& truth, std::optional<double> max_gap) {
  constexpr double kClearlySparser = 1.5;
  const Trajectory finite_truth = finite_poses(truth);
  const Trajectory finite_estimate = finite_poses(estimate);
  Association association;
  association.non_finite = estimate.size() - finite_estimate.size();
  association.interpolates_estimate =
      usual_step(finite_truth) > kClearlySparser * usual_step(finite_estimate);
  const bool swaps = association.interpolates_estimate;
  const Trajectory& sparse = swaps ? finite_truth : finite_estimate;
  const Trajectory& dense = swaps ? finite_estimate : finite_truth;
  association.max_gap = max_gap.value_or(default_max_gap(dense));
  for (const StampedPose& stamped : sparse) {
    const auto other = pose_at(dense, stamped.time);
    if (!other || gap_around(dense, stamped.time) > association.max_gap) {
      ++association.unmatched;
    } else if (swaps) {
      association.pairs.push_back({stamped.time, *other, stamped.pose});
    } else {
      association.pairs.push_back({stamped.time, stamped.pose, *other});
    }
  }
  return association;
}

std::string why_unmatched(const Trajectory& estimate, const Trajectory& truth) {
  if (estimate.empty() || truth.empty()) {
    return std::string(estimate.empty() ? "it" : "the truth") + " holds no poses";
  }
  const auto span = [](const Trajectory& trajectory) {
    return describe_span(trajectory.front().time, trajectory.back().time);
  };
  const std::string spans = fmt::format("poses {}, the truth {}", span(estimate), span(truth));
  if (estimate.front().time <= truth.back().time && truth.front().time <= estimate.back().time) {
    return "no pose lies near a true one in time (--max-gap): " + spans;
  }
  return fmt::format(
      "no pose lies within the time span of the truth: {}; if both began together: "
      "--time-offset={:.3f}",
      spans,
      estimate.front().time - truth.front().time);
}

std::string describe_span(double begin, double end) {
  return fmt::format("from {:.3f} to {:.3f} s ({})", begin, end, clock_of(begin));
}

}  // namespace nvm::eval
