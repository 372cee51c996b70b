// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nvm::io {

/// Watches the times of IMU samples for gaps: intervals above four times the median of the first
/// hundred.
class ImuGapMonitor {
 public:
  /// `time` [s] is above that of the call before.
  void add(double time);

  /// The gaps so far in one sentence; nothing without one.
  std::optional<std::string> summary() const;

 private:
  struct Interval {
    double begin = 0.0;
    double length = 0.0;
  };

  void judge(const Interval& interval);

  std::optional<double> previous_;
  std::vector<Interval> first_;  ///< until the limit is known
  double limit_ = 0.0;           ///< [s]
  std::size_t gap_count_ = 0;
  Interval longest_;
};

}  // namespace nvm::io
