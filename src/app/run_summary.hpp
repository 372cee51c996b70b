// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "app/stages.hpp"
#include "lio/pipeline.hpp"

namespace nvm::app {

/// Whether a frame has a pose that can be trusted.
bool has_pose(const lio::FrameResult& frame);

/// What a run's frames said, summed up: takes the same memory for any number of them.
class RunSummary {
 public:
  void add(const lio::FrameResult& frame);

  std::size_t frames() const { return frames_; }
  std::size_t poses() const { return poses_; }

  /// What was not in order, one line each.
  std::vector<std::string> warnings() const;

  /// Mean and largest CPU time per scan of each stage, as a table.
  std::string timing_table() const;

  /// The same as a JSON object, with `wall_seconds` of the whole run.
  std::string timing_json(double wall_seconds) const;

 private:
  /// Frames whose pose is not what one hopes for.
  struct Trouble {
    lio::FrameStatus status;
    const char* meaning;
    std::size_t count = 0;
    double first_time = 0.0;  ///< [s]
    std::string first_message = {};
  };
  /// CPU time of a stage [ms].
  struct StageSummary {
    double sum = 0.0;
    double max = 0.0;
  };

  double mean(const StageSummary& summary) const;

  std::size_t frames_ = 0;
  std::size_t poses_ = 0;
  std::array<Trouble, 3> troubles_ = {
      {{lio::FrameStatus::kWeak, "their poses are predictions"},
       {lio::FrameStatus::kLost, "they have no pose"},
       {lio::FrameStatus::kSkipped, "they have no pose"}}};
  std::array<StageSummary, 7> summaries_;  ///< in the order of stages()
};

}  // namespace nvm::app
