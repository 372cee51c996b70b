// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/imu_gap_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nvm::io {

namespace {

constexpr std::size_t kFirstCount = 100;

}  // namespace

void ImuGapMonitor::add(double time) {
  const double previous = previous_.value_or(time);
  const bool is_first = !previous_;
  previous_ = time;
  if (is_first) {
    return;
  }
  const Interval interval{previous, time - previous};
  if (limit_ > 0.0) {
    judge(interval);
    return;
  }
  first_.push_back(interval);
  if (first_.size() == kFirstCount) {
    learn();
  }
}

// One or two of the first may be gaps themselves; pauses between bursts are more.
void ImuGapMonitor::learn() {
  constexpr double kGapFactor = 4.0;
  constexpr double kPauseFactor = 10.0;
  std::vector<Interval> sorted = first_;
  std::sort(sorted.begin(), sorted.end(), [](const Interval& a, const Interval& b) {
    return a.length < b.length;
  });
  const double within = sorted[kFirstCount / 4].length;
  const double pause = sorted[kFirstCount - 3].length;
  const bool in_bursts = pause > kPauseFactor * within;
  if (in_bursts) {
    bursts_ = fmt::format(
        "the IMU's readings come in bursts, {:.6f} s apart in them with {:.3f} s between: they are "
        "stamped when they arrive, not when they are taken; let the driver stamp them",
        within,
        pause);
  }
  limit_ = kGapFactor * (in_bursts ? pause : sorted[kFirstCount / 2].length);
  for (const Interval& early : first_) {
    judge(early);
  }
}

void ImuGapMonitor::judge(const Interval& interval) {
  if (interval.length > limit_) {
    ++gap_count_;
    longest_ = interval.length > longest_.length ? interval : longest_;
  }
}

std::optional<std::string> ImuGapMonitor::summary() const {
  std::string summary = bursts_;
  if (gap_count_ > 0) {
    summary += fmt::format(
        "{}the IMU has {} gaps of more than {:.3f} s, the longest of {:.3f} s at t = {:.3f} s",
        summary.empty() ? "" : "; ",
        gap_count_,
        limit_,
        longest_.length,
        longest_.begin);
  }
  return summary.empty() ? std::nullopt : std::optional<std::string>(summary);
}

}  // namespace nvm::io
