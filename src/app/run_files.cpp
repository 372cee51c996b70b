// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_files.hpp"

#include <nlohmann/json.hpp>

#include "app/stages.hpp"
#include "io/trajectory_io.hpp"

namespace nvm::app {

namespace {

nlohmann::ordered_json frame_json(const lio::FrameResult& frame) {
  nlohmann::ordered_json json;
  json["time"] = frame.time;
  json["status"] = lio::name(frame.status);
  json["points"] = frame.points;
  json["keypoints"] = frame.keypoints;
  json["residuals"] = frame.residuals;
  json["residual_rms"] = frame.residual_rms;
  json["degenerate_directions"] = frame.degenerate_directions;
  json["iterations"] = frame.iterations;
  for (const Stage& stage : stages()) {
    json[stage.key] = stage.time(frame.times);
  }
  return json;
}

}  // namespace

RunFiles::RunFiles(const std::string& folder)
    : tum_(folder + "/trajectory.tum"),
      kitti_(folder + "/trajectory_kitti.txt"),
      timing_(folder + "/timing.json") {
  timing_.stream() << "{\n \"frames\": [\n";
}

void RunFiles::add(const lio::FrameResult& frame) {
  timing_.stream() << (is_first_ ? "  " : ",\n  ") << frame_json(frame).dump() << std::flush;
  is_first_ = false;
  if (has_pose(frame)) {
    io::write_tum(tum_.stream(), {frame.time, frame.T_map_body});
    io::write_kitti_pose(kitti_.stream(), frame.T_map_body);
    tum_.stream().flush();
    kitti_.stream().flush();
  }
}

void RunFiles::finish(const RunSummary& summary, double wall_seconds) {
  const std::string sums = summary.timing_json(wall_seconds);
  timing_.stream() << "\n ]," << sums.substr(sums.find('{') + 1) << '\n';
  tum_.commit();
  kitti_.commit();
  timing_.commit();
}

}  // namespace nvm::app
