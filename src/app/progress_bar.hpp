// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace nvm::app {

/// Shows on the terminal how far a run is, on one line of standard error; silent when that is no
/// terminal.
class ProgressBar {
 public:
  /// `total`: steps of the run, 0 when unknown.
  explicit ProgressBar(std::size_t total);
  /// Erases the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// One more step is done; `note` is shown behind the bar.
  void step(const std::string& note);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const std::string& note) const;

  std::size_t total_;
  std::size_t done_ = 0;
  bool is_terminal_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point drawn_ = begin_;
};

}  // namespace nvm::app
