// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "app/run_summary.hpp"
#include "io/file.hpp"
#include "lio/pipeline.hpp"

namespace nvm::app {

/// What a run says frame by frame, in files that grow with it, so that memory does not:
/// trajectory.tum and trajectory_kitti.txt (T_map_body of the frames with a pose) and timing.json
/// (a line per frame).
///
/// Each frame is in the files when add() returns. They get their names when the run is complete: of
/// a run that is killed, files with the ending .part and a number remain, whole up to its last
/// frame; of one that fails, nothing does.
class RunFiles {
 public:
  /// Throws std::runtime_error when `folder` cannot be written to.
  explicit RunFiles(const std::string& folder);

  void add(const lio::FrameResult& frame);

  /// Completes the files with what sums the frames up. Throws std::runtime_error when something
  /// could not be written.
  void finish(const RunSummary& summary, double wall_seconds);

 private:
  io::AtomicFile tum_;
  io::AtomicFile kitti_;
  io::AtomicFile timing_;
  bool is_first_ = true;  ///< of the frames, none of which is in timing.json
};

}  // namespace nvm::app
