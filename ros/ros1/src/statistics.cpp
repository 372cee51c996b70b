// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "statistics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outputs.hpp"

namespace nvm_ros {

namespace {

using diagnostic_msgs::DiagnosticStatus;
using nvm::lio::FrameStatus;

std::uint8_t level_of(FrameStatus status) {
  switch (status) {
    case FrameStatus::kTracking:
      return DiagnosticStatus::OK;
    case FrameStatus::kLost:
      return DiagnosticStatus::ERROR;
    default:
      return DiagnosticStatus::WARN;
  }
}

/// Raises the level of `status`, whose message becomes that of the worst.
void raise(std::uint8_t level, const std::string& message, DiagnosticStatus& status) {
  if (level > status.level) {
    status.level = level;
    status.message = message;
  }
}

template <class Value>
void add_value(const char* key, const Value& value, DiagnosticStatus& status) {
  diagnostic_msgs::KeyValue entry;
  entry.key = key;
  entry.value = fmt::format("{}", value);
  status.values.push_back(entry);
}

}  // namespace

void Statistics::add(const nvm::lio::FrameResult& frame, Clock::time_point arrival) {
  const double latency = std::chrono::duration<double>(Clock::now() - arrival).count();
  last_ = frame;
  ++scans_;
  ++period_.scans;
  poses_ += has_pose(frame) ? 1 : 0;
  period_.latency_sum += latency;
  period_.latency_max = std::max(period_.latency_max, latency);
  period_.cpu_sum += frame.times.total();
}

void Statistics::add_bad(const std::string& problem) {
  ++bad_;
  ++period_.bad;
  bad_problem_ = problem;
}

void Statistics::note(const std::string& text, bool is_warning) {
  (is_warning ? warnings_ : notes_).push_back(text);
}

std::string Statistics::drops(const QueueStats& queue) const {
  const std::size_t dropped = queue.dropped - period_.queue.dropped;
  return dropped == 0 ? ""
                      : fmt::format(
                            "cannot keep up: {} of {} scans dropped; set lidar.max_points or "
                            "matching.max_keypoints lower, or threads higher",
                            dropped,
                            queue.clouds - period_.queue.clouds);
}

void Statistics::judge(
    const QueueStats& queue, const std::string& finding, DiagnosticStatus& status) const {
  status.level = DiagnosticStatus::OK;
  status.message = "tracking";
  if (!finding.empty()) {
    raise(DiagnosticStatus::ERROR, finding, status);
  }
  if (!last_) {
    raise(DiagnosticStatus::WARN, "no scan yet", status);
  } else {
    const std::string why = last_->message.empty() ? "" : ": " + last_->message;
    raise(level_of(last_->status), nvm::lio::name(last_->status) + why, status);
  }
  if (const std::string dropped = drops(queue); !dropped.empty()) {
    raise(DiagnosticStatus::WARN, dropped, status);
  }
  if (period_.bad > 0) {
    raise(DiagnosticStatus::WARN, "scans that cannot be read: " + bad_problem_, status);
  }
  if (!warnings_.empty()) {
    raise(DiagnosticStatus::WARN, warnings_.front(), status);
  }
}

void Statistics::add_values(const QueueStats& queue, DiagnosticStatus& status) const {
  const double duration = std::chrono::duration<double>(Clock::now() - period_.begin).count();
  const double count = std::max(1.0, static_cast<double>(period_.scans));
  const auto rate = [duration](std::size_t now, std::size_t before) {
    return fmt::format("{:.2f}", static_cast<double>(now - before) / duration);
  };
  const auto decimal = [](double value) { return fmt::format("{:.1f}", value); };
  add_value("scans", scans_, status);
  add_value("scans with a pose", poses_, status);
  add_value("scans dropped", queue.dropped, status);
  add_value("scans that could not be read", bad_, status);
  add_value("IMU readings", queue.imu, status);
  add_value("IMU readings left out", queue.bad_imu, status);
  add_value("scan rate [Hz]", rate(queue.clouds, period_.queue.clouds), status);
  add_value("IMU rate [Hz]", rate(queue.imu, period_.queue.imu), status);
  add_value("latency, mean [ms]", decimal(1e3 * period_.latency_sum / count), status);
  add_value("latency, max [ms]", decimal(1e3 * period_.latency_max), status);
  add_value("CPU time of a scan, mean [ms]", decimal(period_.cpu_sum / count), status);
  add_value("resets", resets_, status);
}

DiagnosticStatus Statistics::report(
    const QueueStats& queue, std::size_t map_points, const std::string& finding) {
  DiagnosticStatus status;
  judge(queue, finding, status);
  add_value("status", last_ ? nvm::lio::name(last_->status) : "none", status);
  add_values(queue, status);
  if (last_) {
    add_value("points", last_->points, status);
    add_value("residuals", last_->residuals, status);
    add_value("residual RMS [m]", fmt::format("{:.4f}", last_->residual_rms), status);
    add_value("directions of the pose not seen", last_->degenerate_directions, status);
  }
  add_value("map points", map_points, status);
  for (const auto* texts : {&warnings_, &notes_}) {
    for (const std::string& text : *texts) {
      add_value("note", text, status);
    }
  }
  period_ = {};
  period_.queue = queue;
  return status;
}

}  // namespace nvm_ros
