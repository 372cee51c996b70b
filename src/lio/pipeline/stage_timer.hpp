// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <ctime>

namespace nvm::lio {

/// Adds the process's CPU time [ms] of a scope to `total_ms`: unlike wall time it tells the cost of
/// a stage on a busy machine too.
class StageTimer {
 public:
  explicit StageTimer(double& total_ms) : total_ms_(total_ms), begin_ms_(now_ms()) {}
  ~StageTimer() { total_ms_ += now_ms() - begin_ms_; }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  static double now_ms() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  double& total_ms_;
  double begin_ms_;
};

}  // namespace nvm::lio
