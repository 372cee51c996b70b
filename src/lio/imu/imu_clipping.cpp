// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_clipping.hpp"

#include <algorithm>
#include <cmath>

namespace nvm::lio {

void ImuClipping::add(const Eigen::Vector3d& reading) {
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    const int after = (axis + 2) % 3;
    const bool others_change = reading[next] != last_[next] || reading[after] != last_[after];
    tracks_[static_cast<std::size_t>(axis)].add(reading[axis], others_change);
  }
  last_ = reading;
  ++count_;
}

// A larger value says that what seemed the limit was none. A reading that repeats on all axes is
// one that was sent twice.
void ImuClipping::Track::add(double value, bool others_change) {
  const double size = std::abs(value);
  const double step = std::abs(value - last);
  if (step > 0.0) {
    smallest_step = std::min(smallest_step, step);
  }
  same = step > 0.0 ? 0 : same + (others_change ? 1 : 0);
  if (same > frozen) {
    frozen = same;
    frozen_at = value;
  }
  if (size > limit) {
    limit = size;
    runs = count = 0;
    run = 1;
    step_in = step;
  } else if (size < limit) {
    end_run(step);
  } else if (run == 0) {
    run = 1;
    step_in = step;
  } else if (others_change) {
    ++run;
  }
  last = value;
}

// Coarse readings stand still at the turn of a smooth motion as well, but come and go by one step.
void ImuClipping::Track::end_run(double step_out) {
  constexpr std::size_t kShortest = 3;
  constexpr double kLeap = 4.0;  // smallest steps
  if (run >= kShortest && std::max(step_in, step_out) > kLeap * smallest_step) {
    ++runs;
    count += run;
  }
  run = 0;
}

std::optional<ImuClipping::Axis> ImuClipping::clipped() const {
  constexpr std::size_t kFewest = 2;  // runs
  constexpr double kMinShare = 0.01;
  Axis worst;
  for (int axis = 0; axis < 3; ++axis) {
    const Track& track = tracks_[static_cast<std::size_t>(axis)];
    const double share = static_cast<double>(track.count) / static_cast<double>(count_);
    if (track.runs >= kFewest && share > std::max(kMinShare, worst.share)) {
      worst = {axis, track.limit, share};
    }
  }
  return worst.share > 0.0 ? std::optional(worst) : std::nullopt;
}

std::optional<ImuClipping::Axis> ImuClipping::stuck() const {
  constexpr std::size_t kLong = 50;
  for (int axis = 0; axis < 3; ++axis) {
    const Track& track = tracks_[static_cast<std::size_t>(axis)];
    if (track.run >= kLong && track.limit > 0.0) {
      const double share = static_cast<double>(track.run) / static_cast<double>(count_);
      return Axis{axis, track.limit, share};
    }
  }
  return std::nullopt;
}

std::optional<ImuClipping::Axis> ImuClipping::frozen() const {
  constexpr std::size_t kLong = 400;
  constexpr double kMinShare = 0.5;
  for (int axis = 0; axis < 3; ++axis) {
    const Track& track = tracks_[static_cast<std::size_t>(axis)];
    const double share = static_cast<double>(track.frozen) / static_cast<double>(count_);
    if (track.frozen >= kLong && share > kMinShare) {
      return Axis{axis, track.frozen_at, share};
    }
  }
  return std::nullopt;
}

}  // namespace nvm::lio
