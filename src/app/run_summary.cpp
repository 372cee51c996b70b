// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace nvm::app {

using lio::FrameResult;
using lio::FrameStatus;

bool has_pose(const FrameResult& frame) {
  return frame.status == FrameStatus::kTracking || frame.status == FrameStatus::kWeak;
}

void RunSummary::add(const FrameResult& frame) {
  ++frames_;
  poses_ += has_pose(frame) ? 1 : 0;
  for (Trouble& trouble : troubles_) {
    if (frame.status == trouble.status && ++trouble.count == 1) {
      trouble.first_time = frame.time;
      trouble.first_message = frame.message;
    }
  }
  for (std::size_t i = 0; i < summaries_.size(); ++i) {
    const double time = stages()[i].time(frame.times);
    summaries_[i].sum += time;
    summaries_[i].max = std::max(summaries_[i].max, time);
  }
}

std::vector<std::string> RunSummary::warnings() const {
  std::vector<std::string> warnings;
  for (const Trouble& trouble : troubles_) {
    if (trouble.count > 0) {
      warnings.push_back(fmt::format(
          "{} of {} scans {} ({}), the first at {:.3f} s: {}",
          trouble.count,
          frames_,
          lio::name(trouble.status),
          trouble.meaning,
          trouble.first_time,
          trouble.first_message));
    }
  }
  return warnings;
}

double RunSummary::mean(const StageSummary& summary) const {
  return summary.sum / static_cast<double>(std::max<std::size_t>(1, frames_));
}

std::string RunSummary::timing_table() const {
  std::string table =
      fmt::format("{:<20}{:>12}{:>12}{:>12}\n", "CPU time", "mean ms", "max ms", "sum s");
  for (std::size_t i = 0; i < summaries_.size(); ++i) {
    const StageSummary& summary = summaries_[i];
    table += fmt::format(
        "{:<20}{:>12.2f}{:>12.2f}{:>12.2f}\n",
        stages()[i].name,
        mean(summary),
        summary.max,
        1e-3 * summary.sum);
  }
  return table;
}

std::string RunSummary::timing_json(double wall_seconds) const {
  nlohmann::ordered_json json;
  json["scans"] = frames_;
  json["wall_seconds"] = wall_seconds;
  for (std::size_t i = 0; i < summaries_.size(); ++i) {
    const StageSummary& summary = summaries_[i];
    json["cpu"][stages()[i].key] = {
        {"mean", mean(summary)}, {"max", summary.max}, {"sum", summary.sum}};
  }
  return json.dump(1);
}

}  // namespace nvm::app
