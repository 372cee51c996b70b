// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lio/pipeline/pipeline.hpp"
#include "sensor_queue.hpp"

namespace nvm_ros {

/// What a run has said since its begin, and since the last report.
class Statistics {
 public:
  using Clock = std::chrono::steady_clock;

  /// Takes a scan that came at `arrival` and has just been finished.
  void add(const nvm::lio::FrameResult& frame, Clock::time_point arrival);
  /// Takes a scan that could not be read, and why.
  void add_bad(const std::string& problem);
  void count_reset() { ++resets_; }
  /// Something that the user should know and that stays as it is: a warning when the result may be
  /// wrong for it.
  void note(const std::string& text, bool is_warning);
  /// Forgets the warnings among the notes.
  void clear_warnings() { warnings_.clear(); }

  /// What to say about scans dropped since the last report; empty without any.
  std::string drops(const QueueStats& queue) const;

  /// The state as diagnostics: ok when the last scan was tracked and none was dropped or bad since
  /// the last report, a warning or an error else, with the reason as message. `finding`: what is
  /// wrong with the input as a whole; empty: nothing. Begins a new period.
  diagnostic_msgs::DiagnosticStatus report(
      const QueueStats& queue, std::size_t map_points, const std::string& finding);

 private:
  struct Period {
    Clock::time_point begin = Clock::now();
    std::size_t scans = 0;
    std::size_t bad = 0;
    double latency_sum = 0.0;  // [s]
    double latency_max = 0.0;  // [s]
    double cpu_sum = 0.0;      // [ms]
    QueueStats queue;          // at its begin
  };

  void judge(
      const QueueStats& queue,
      const std::string& finding,
      diagnostic_msgs::DiagnosticStatus& status) const;
  void add_values(const QueueStats& queue, diagnostic_msgs::DiagnosticStatus& status) const;

  std::optional<nvm::lio::FrameResult> last_;
  Period period_;
  std::size_t scans_ = 0;
  std::size_t poses_ = 0;
  std::size_t bad_ = 0;
  std::size_t resets_ = 0;
  std::string bad_problem_;
  std::vector<std::string> notes_;
  std::vector<std::string> warnings_;
};

}  // namespace nvm_ros
