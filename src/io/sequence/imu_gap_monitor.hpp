// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nvm::io {

/// Watches the times of IMU samples for gaps: intervals above four times the usual one of the first
/// hundred, their median, or for samples that come in bursts the pause between those.
class ImuGapMonitor {
 public:
  /// `time` [s] is above that of the call before.
  void add(double time);

  /// The bursts and the gaps so far, a sentence for each; nothing without one.
  std::optional<std::string> summary() const;

 private:
  struct Interval {
    double begin = 0.0;
    double length = 0.0;
  };

  void learn();
  void judge(const Interval& interval);

  std::optional<double> previous_;
  std::vector<Interval> first_;  ///< until the limit is known
  std::string bursts_;           ///< what to say of them, if there are any
  double limit_ = 0.0;           ///< [s]
  std::size_t gap_count_ = 0;
  Interval longest_;
};

}  // namespace nvm::io
