// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_files.hpp"

#include <sstream>

#include "app/frame_table.hpp"
#include "io/sequence/trajectory_io.hpp"

namespace nvm::app {

RunFiles::RunFiles(const std::string& folder, const Eigen::Vector3d& origin)
    : origin_(origin),
      tum_(folder + "/trajectory.tum"),
      kitti_(folder + "/trajectory_kitti.txt"),
      frames_(folder + "/frames.csv") {
  frames_.append(frame_header());
}

void RunFiles::add(const lio::FrameResult& frame) {
  frames_.append(frame_row(frame));
  if (has_pose(frame)) {
    Pose pose = frame.T_map_body;
    pose.translation() += origin_;
    std::ostringstream tum;
    io::write_tum(tum, {frame.time, pose});
    tum_.append(tum.str());
    std::ostringstream kitti;
    io::write_kitti_pose(kitti, pose);
    kitti_.append(kitti.str());
  }
}

void write_timing(const std::string& folder, const RunSummary& summary, double wall_seconds) {
  LineFile(folder + "/timing.json").append(summary.timing_json(wall_seconds) + '\n');
}

}  // namespace nvm::app
