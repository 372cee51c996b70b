// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nvm::app {

/// The times of a run in which something was so; keeps the longest, so that memory does not grow.
class TimeSpans {
 public:
  /// Whether it is so at `time` [s]. Times ascend.
  void add(double time, bool is_so);

  /// Of the times at which it was so.
  std::size_t count() const { return count_; }

  /// "3.1 to 6.0 s, at 8.2 s and 4 shorter times", counted from `begin` [s]; empty for none.
  std::string describe(double begin) const;

 private:
  struct Span {
    double begin = 0.0;
    double end = 0.0;
    double length() const { return end - begin; }
  };

  std::vector<Span> longest_;  ///< in order of time, the last one is open while it is so
  std::size_t count_ = 0;
  std::size_t dropped_ = 0;  ///< spans that are no longer kept
  bool is_open_ = false;
};

}  // namespace nvm::app
