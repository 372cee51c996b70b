// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace nvm::app {

namespace {

using lio::FrameResult;
using lio::FrameStatus;
using lio::StageTimes;

struct Stage {
  const char* name;
  const char* key;
  double (*time)(const StageTimes&);
};

// The stages of the paper's timing table (spec §6) and those that they consist of.
constexpr Stage kStages[] = {
    {"Deskew", "deskew_ms", [](const StageTimes& t) { return t.deskew; }},
    {"Normals", "normals_ms", [](const StageTimes& t) { return t.normals; }},
    {"Map update", "map_update_ms", [](const StageTimes& t) { return t.map_update; }},
    {"Optimise", "optimize_ms", [](const StageTimes& t) { return t.optimize; }},
    {"Pose estimation",
     "pose_estimation_ms",
     [](const StageTimes& t) { return t.pose_estimation(); }},
    {"Process measurement", "measurement_ms", [](const StageTimes& t) { return t.measurement(); }},
    {"Total", "total_ms", [](const StageTimes& t) { return t.total(); }}};

struct Summary {
  double sum = 0.0;
  double max = 0.0;
};

Summary summarize(const std::vector<FrameResult>& frames, const Stage& stage) {
  Summary summary;
  for (const FrameResult& frame : frames) {
    const double time = stage.time(frame.times);
    summary.sum += time;
    summary.max = std::max(summary.max, time);
  }
  return summary;
}

bool has_pose(const FrameResult& frame) {
  return frame.status == FrameStatus::kTracking || frame.status == FrameStatus::kWeak;
}

nlohmann::ordered_json frame_json(const FrameResult& frame) {
  nlohmann::ordered_json json;
  json["time"] = frame.time;
  json["status"] = lio::name(frame.status);
  json["points"] = frame.points;
  json["keypoints"] = frame.keypoints;
  json["residuals"] = frame.residuals;
  json["residual_rms"] = frame.residual_rms;
  json["degenerate_directions"] = frame.degenerate_directions;
  json["iterations"] = frame.iterations;
  for (const Stage& stage : kStages) {
    json[stage.key] = stage.time(frame.times);
  }
  return json;
}

}  // namespace

void RunRecord::add(const FrameResult& frame) { frames_.push_back(frame); }

Trajectory RunRecord::trajectory() const {
  Trajectory trajectory;
  for (const FrameResult& frame : frames_) {
    if (has_pose(frame)) {
      trajectory.push_back({frame.time, frame.T_map_body});
    }
  }
  return trajectory;
}

std::size_t RunRecord::count(FrameStatus status) const {
  return static_cast<std::size_t>(
      std::count_if(frames_.begin(), frames_.end(), [status](const FrameResult& frame) {
        return frame.status == status;
      }));
}

std::vector<std::string> RunRecord::warnings() const {
  std::vector<std::string> warnings;
  for (const auto& [status, meaning] :
       {std::pair{FrameStatus::kWeak, "their poses are predictions"},
        std::pair{FrameStatus::kLost, "they have no pose"},
        std::pair{FrameStatus::kSkipped, "they have no pose"}}) {
    const auto first =
        std::find_if(frames_.begin(), frames_.end(), [status = status](const FrameResult& frame) {
          return frame.status == status;
        });
    if (first != frames_.end()) {
      warnings.push_back(fmt::format(
          "{} of {} scans {} ({}), the first at {:.3f} s: {}",
          count(status),
          frames_.size(),
          lio::name(status),
          meaning,
          first->time,
          first->message));
    }
  }
  return warnings;
}

std::string RunRecord::timing_table() const {
  std::string table =
      fmt::format("{:<20}{:>12}{:>12}{:>12}\n", "CPU time", "mean ms", "max ms", "sum s");
  for (const Stage& stage : kStages) {
    const Summary summary = summarize(frames_, stage);
    table += fmt::format(
        "{:<20}{:>12.2f}{:>12.2f}{:>12.2f}\n",
        stage.name,
        summary.sum / static_cast<double>(std::max<std::size_t>(1, frames_.size())),
        summary.max,
        1e-3 * summary.sum);
  }
  return table;
}

std::string RunRecord::timing_json(double wall_seconds) const {
  nlohmann::ordered_json json;
  json["scans"] = frames_.size();
  json["wall_seconds"] = wall_seconds;
  for (const Stage& stage : kStages) {
    const Summary summary = summarize(frames_, stage);
    json["cpu"][stage.key] = {
        {"mean", summary.sum / static_cast<double>(std::max<std::size_t>(1, frames_.size()))},
        {"max", summary.max},
        {"sum", summary.sum}};
  }
  json["frames"] = nlohmann::ordered_json::array();
  for (const FrameResult& frame : frames_) {
    json["frames"].push_back(frame_json(frame));
  }
  return json.dump(1);
}

}  // namespace nvm::app
