// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/clock_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "lio/imu_findings.hpp"
#include "lio/printed.hpp"

namespace nvm::lio {

namespace {

/// How the turns of scans and gyroscope differ at an offset: sums of squares and products of the
/// differences and of what they change by with the offset.
struct Differences {
  double sq_difference = 0.0;  ///< [rad^2]
  double sq_change = 0.0;      ///< [rad^2/s^2]
  double both = 0.0;           ///< [rad^2/s]
  std::size_t count = 0;
};

/// A mean difference is the gyroscope's bias.
Differences differences_at(
    const MotionHistory& history,
    const std::vector<MotionHistory::Turn>& turns,
    double begin,
    double offset) {
  constexpr double kStep = 0.01;  // [s]
  const auto turned = [&](const MotionHistory::Turn& turn, double o) {
    const auto from = history.turned_at(turn.begin + o);
    const auto to = history.turned_at(turn.end + o);
    return from && to ? std::optional<Eigen::Vector3d>(*to - *from) : std::nullopt;
  };
  std::vector<Eigen::Vector3d> differences, changes;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_change = Eigen::Vector3d::Zero();
  for (const MotionHistory::Turn& turn : turns) {
    const auto now = turned(turn, offset);
    const auto before = turned(turn, offset - kStep);
    const auto after = turned(turn, offset + kStep);
    if (turn.begin >= begin && now && before && after) {
      differences.emplace_back(turn.by_scans - *now);
      changes.emplace_back((*after - *before) / (2.0 * kStep));
      mean += differences.back();
      mean_change += changes.back();
    }
  }
  Differences sums;
  sums.count = differences.size();
  const double share = 1.0 / std::max<double>(1.0, static_cast<double>(sums.count));
  mean *= share;
  mean_change *= share;
  for (std::size_t i = 0; i < sums.count; ++i) {
    const Eigen::Vector3d difference = differences[i] - mean;
    sums.sq_difference += difference.squaredNorm();
    const Eigen::Vector3d change = changes[i] - mean_change;
    sums.sq_change += change.squaredNorm();
    sums.both += difference.dot(change);
  }
  return sums;
}

}  // namespace

void ClockWatch::look(const MotionHistory& history, double begin) {
  constexpr std::size_t kMinCount = 10;  // of turns
  constexpr double kMinChange = 5e-4;    // of the rate between turns, mean square [rad^2/s^2]
  constexpr double kMaxOffset = 0.1;     // [s]
  constexpr int kIterations = 4;
  const std::vector<MotionHistory::Turn> turns = history.turns();
  const Differences at_zero = differences_at(history, turns, begin, 0.0);
  if (at_zero.count < kMinCount ||
      at_zero.sq_change < kMinChange * static_cast<double>(at_zero.count)) {
    return;
  }
  double offset = 0.0;
  Differences there = at_zero;
  for (int i = 0; i < kIterations && there.sq_change > 0.0; ++i) {
    offset = std::clamp(offset + there.both / there.sq_change, -kMaxOffset, kMaxOffset);
    there = differences_at(history, turns, begin, offset);
  }
  if (there.count < kMinCount) {
    return;
  }
  const double time = turns.back().end;
  first_ = w_ > 0.0 ? first_ : time;
  last_ = time;
  const double t = time - first_;
  const double weight = at_zero.sq_change;
  w_ += weight;
  wt_ += weight * t;
  wo_ += weight * offset;
  wtt_ += weight * t * t;
  wto_ += weight * t * offset;
  before_ += at_zero.sq_difference / static_cast<double>(at_zero.count);
  after_ += there.sq_difference / static_cast<double>(there.count);
}

ClockWatch::Line ClockWatch::fit() const {
  constexpr double kMinSpread = 5.0;  // of the stretches in time, to tell a drift [s]
  if (!(w_ > 0.0)) {
    return {0.0, 0.0};
  }
  const double mean = wo_ / w_;
  const double mean_time = wt_ / w_;
  const double variance = wtt_ / w_ - mean_time * mean_time;
  if (variance < kMinSpread * kMinSpread) {
    return {mean, mean};
  }
  const double drift = (wto_ / w_ - mean_time * mean) / variance;
  return {mean - drift * mean_time, mean + drift * (last_ - first_ - mean_time)};
}

std::string ClockWatch::finding() const {
  constexpr double kLeast = 0.0025;      // [s]
  constexpr double kExplained = 0.75;    // of the differences may be left
  constexpr double kLeastDrift = 0.004;  // over the run [s]
  const Line line = fit();
  const bool is_off = std::max(std::abs(line.begin), std::abs(line.end)) > kLeast;
  if (!is_off || after_ > kExplained * before_) {
    return "";
  }
  const double mean = 0.5 * (line.begin + line.end);
  if (std::abs(line.end - line.begin) > kLeastDrift) {
    return printed(
        "the IMU's clock drifts: it is %.0f ms late at first and %.0f ms in the end (negative: "
        "early), or more, since the gyroscope turns when the scans do only then; let both sensors "
        "have one clock (PTP, PPS)",
        1e3 * line.begin,
        1e3 * line.end);
  }
  return offset_finding(mean) +
         ", or more: poses lean on the IMU, so run again to see what is left";
}

}  // namespace nvm::lio
