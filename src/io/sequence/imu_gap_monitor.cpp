// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/imu_gap_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nvm::io {

void ImuGapMonitor::add(double time) {
  constexpr std::size_t kFirstCount = 100;
  constexpr double kGapFactor = 4.0;
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
    std::vector<Interval> sorted = first_;
    const auto median = sorted.begin() + kFirstCount / 2;
    std::nth_element(
        sorted.begin(), median, sorted.end(), [](const Interval& a, const Interval& b) {
          return a.length < b.length;
        });
    limit_ = kGapFactor * median->length;
    for (const Interval& early : first_) {
      judge(early);
    }
  }
}

void ImuGapMonitor::judge(const Interval& interval) {
  if (interval.length > limit_) {
    ++gap_count_;
    longest_ = interval.length > longest_.length ? interval : longest_;
  }
}

std::optional<std::string> ImuGapMonitor::summary() const {
  if (gap_count_ == 0) {
    return std::nullopt;
  }
  return fmt::format(
      "the IMU has {} gaps of more than {:.3f} s, the longest of {:.3f} s at t = {:.3f} s",
      gap_count_,
      limit_,
      longest_.length,
      longest_.begin);
}

}  // namespace nvm::io
