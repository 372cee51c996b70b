// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lio/pipeline.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::app {

/// What a run's frames said: the trajectory and the times.
class RunRecord {
 public:
  void add(const lio::FrameResult& frame);

  std::size_t frames() const { return frames_.size(); }

  /// T_map_body of the frames that have a pose which can be trusted.
  Trajectory trajectory() const;

  /// What was not in order, one line each.
  std::vector<std::string> warnings() const;

  /// Mean and largest CPU time per scan of each stage, as a table.
  std::string timing_table() const;

  /// The same and the times of every frame as JSON, with `wall_seconds` of the whole run.
  std::string timing_json(double wall_seconds) const;

 private:
  std::size_t count(lio::FrameStatus status) const;

  std::vector<lio::FrameResult> frames_;
};

}  // namespace nvm::app
