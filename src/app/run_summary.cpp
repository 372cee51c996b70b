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
  return lio::is_believed(frame.status) || frame.status == FrameStatus::kWeak;
}

void RunSummary::note_pause(double time) {
  begin_ = frames_ == 0 ? time : begin_;
  if (frames_ > 0 && time - end_ > longest_pause_) {
    longest_pause_ = time - end_;
    longest_pause_begin_ = end_;
  }
  end_ = time;
}

void RunSummary::add(const FrameResult& frame, std::size_t returns) {
  constexpr std::size_t kMaxMessages = 16;
  note_pause(frame.time);
  imu_noise_ = frame.imu_noise;
  has_imu_ = has_imu_ || frame.imu_noise.gyro > 0.0;
  imu_time_offset_ = frame.imu_time_offset;
  ++frames_;
  const bool is_waiting =
      frame.status == FrameStatus::kInitializing && frame.message != lio::kTooFewSurfaces;
  if (!is_waiting && frame.status != FrameStatus::kSkipped) {
    returns_ += std::min(returns, max_points_);
  }
  poses_ += has_pose(frame) ? 1 : 0;
  inserted_.add(frame.points, frame.inserted);
  usable_ += frame.status == FrameStatus::kTracking ? 1 : 0;
  const bool slides = frame.status == FrameStatus::kDegenerate;
  unobserved_.add(frame.time, slides);
  if (slides) {
    unobserved_along_.add(frame.unobserved.translations);
    unobserved_about_.add(frame.unobserved.rotations);
  }
  for (Trouble& trouble : troubles_) {
    trouble.spans.add(frame.time, frame.status == trouble.status);
    if (frame.status == trouble.status &&
        (trouble.messages.size() < kMaxMessages || trouble.messages.count(frame.message) > 0)) {
      ++trouble.messages[frame.message];
    }
  }
  for (std::size_t i = 0; i < summaries_.size(); ++i) {
    const double time = stages()[i].time(frame.times);
    summaries_[i].sum += time;
    summaries_[i].max = std::max(summaries_[i].max, time);
  }
}

std::string RunSummary::describe(const Trouble& trouble) const {
  return fmt::format(
      "{} of {} scans {} ({}): {}; {}",
      trouble.spans.count(),
      frames_,
      lio::name(trouble.status),
      trouble.meaning,
      trouble.spans.describe(begin_),
      trouble.usual_message());
}

std::string RunSummary::Trouble::usual_message() const {
  const auto usual =
      std::max_element(messages.begin(), messages.end(), [](const auto& a, const auto& b) {
        return a.second < b.second;
      });
  return usual == messages.end() ? "" : usual->first;
}

std::string RunSummary::main_trouble() const {
  const auto most =
      std::max_element(troubles_.begin(), troubles_.end(), [](const Trouble& a, const Trouble& b) {
        return a.spans.count() < b.spans.count();
      });
  const std::string range = range_warning();
  return most->spans.count() > 0 ? describe(*most) + (range.empty() ? "" : ". " + range) : "";
}

std::string RunSummary::range_warning() const {
  constexpr std::size_t kLeastShare = 4;  // of the returns: one in so many is used
  if (kLeastShare * inserted_.points >= returns_) {
    return "";
  }
  return fmt::format(
      "{:.0f} % of the returns lie nearer than lidar.min_range or farther than lidar.max_range: "
      "are coordinates in metres?",
      100.0 * (1.0 - static_cast<double>(inserted_.points) / static_cast<double>(returns_)));
}

std::vector<std::string> RunSummary::warnings() const {
  std::vector<std::string> warnings;
  add_input_warnings(warnings);
  for (const Trouble& trouble : troubles_) {
    // Every run with an IMU begins without a pose; that is only told of one that got none.
    const bool is_usual = trouble.status == FrameStatus::kInitializing && poses_ > 0;
    if (trouble.spans.count() > 0 && !is_usual) {
      warnings.push_back(describe(trouble));
    }
  }
  if (unobserved_.count() > 0) {
    warnings.push_back(fmt::format(
        "{} of {} scans degenerate: for too long nothing has told all directions of the pose, as "
        "in a tunnel, at one wall or in the open (there it drifts{}): {}",
        unobserved_.count(),
        frames_,
        unobserved_directions(),
        unobserved_.describe(begin_)));
  }
  add_map_warnings(warnings);
  return warnings;
}

std::string RunSummary::unobserved_directions() const {
  const auto text = [](const char* how, const std::optional<Eigen::Vector3d>& axis) {
    return axis ? fmt::format("{} {}", how, lio::axis_text(*axis)) : "";
  };
  return text(", mostly along", unobserved_along_.axis()) +
         text(", turning about", unobserved_about_.axis());
}

void RunSummary::add_input_warnings(std::vector<std::string>& warnings) const {
  constexpr double kLeastPause = 0.5;   // [s]
  constexpr double kUsualPauses = 5.0;  // that the longest one is worth a word beyond
  const double usual_pause =
      (end_ - begin_) / static_cast<double>(std::max<std::size_t>(1, frames_));
  if (longest_pause_ > std::max(kLeastPause, kUsualPauses * usual_pause)) {
    warnings.push_back(fmt::format(
        "no scan came for {:.1f} s after {:.1f} s (dropped messages?){}",
        longest_pause_,
        longest_pause_begin_ - begin_,
        has_imu_ ? "" : ": without an IMU the way between is a guess"));
  }
  if (const std::string range = range_warning(); !range.empty()) {
    warnings.push_back(range);
  }
}

void RunSummary::add_map_warnings(std::vector<std::string>& warnings) const {
  const InsertStats& stats = inserted_.stats;
  if (stats.out_of_range > 0) {
    warnings.push_back(fmt::format(
        "{} points are not in the map: they lie more than 2^20 voxels from its origin (are "
        "coordinates in millimetres, or those of a country's grid?)",
        stats.out_of_range));
  }
  if (stats.map_full > 0) {
    warnings.push_back(fmt::format(
        "{} points are not in the map: map.max_bytes is too small for a single scan",
        stats.map_full));
  }
  if (stats.evicted_points > 0) {
    warnings.push_back(fmt::format(
        "{} points of {} voxels have left the map, which was full (map.capacity, map.eviction)",
        stats.evicted_points,
        stats.evicted_voxels));
  }
}

std::string RunSummary::counts() const {
  std::string counts;
  const auto add = [&](std::size_t count, const std::string& what) {
    if (count > 0) {
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, what);
    }
  };
  for (const Trouble& trouble : troubles_) {
    add(trouble.spans.count(), lio::name(trouble.status));
  }
  add(unobserved_.count(), lio::name(FrameStatus::kDegenerate));
  return counts;
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
  json["imu"] = {
      {"gyro_noise", imu_noise_.gyro},
      {"accel_noise", imu_noise_.accel},
      {"time_offset", imu_time_offset_}};
  for (std::size_t i = 0; i < summaries_.size(); ++i) {
    const StageSummary& summary = summaries_[i];
    json["cpu"][stages()[i].key] = {
        {"mean", mean(summary)}, {"max", summary.max}, {"sum", summary.sum}};
  }
  return json.dump(1);
}

}  // namespace nvm::app
