// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <string>

#include "app/line_file.hpp"
#include "app/run_summary.hpp"
#include "lio/pipeline/pipeline.hpp"

namespace nvm::app {

/// What a run says frame by frame, in files that grow with it, so that memory does not:
/// trajectory.tum and trajectory_kitti.txt (T_map_body of the frames with a pose) and frames.csv (a
/// line per frame). Each frame is in the files when add() returns.
class RunFiles {
 public:
  /// Makes the files in `folder`; poses are written with the map's origin at `origin` [m]. Throws
  /// std::runtime_error.
  explicit RunFiles(
      const std::string& folder, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

  /// Throws std::runtime_error when the disk is full; the frames before are whole then.
  void add(const lio::FrameResult& frame);

 private:
  Eigen::Vector3d origin_;
  LineFile tum_;
  LineFile kitti_;
  LineFile frames_;
};

/// Writes timing.json, which sums the frames up, to `folder`. Throws std::runtime_error.
void write_timing(const std::string& folder, const RunSummary& summary, double wall_seconds);

}  // namespace nvm::app
