// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/clock_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "lio/imu/imu_findings.hpp"

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

/// Of an offset [s] that shows, the poses may have hidden as much as half.
double hidden_variance(double offset) { return 0.25 * offset * offset; }

}  // namespace

bool ClockWatch::look(const MotionHistory& history, double begin) {
  constexpr std::size_t kMinCount = 10;  // of turns
  constexpr double kMinChange = 5e-3;    // of the rate between turns, squares added up [rad^2/s^2]
  constexpr double kMaxOffset = 0.1;     // [s]
  constexpr int kIterations = 4;
  constexpr double kWander = 1e-4;         // of clocks, in a second [s]
  constexpr double kLeastVariance = 1e-8;  // of a stretch [s^2]
  constexpr double kSure = 0.01;           // [s]
  const std::vector<MotionHistory::Turn> turns = history.turns();
  Differences there = differences_at(history, turns, begin, 0.0);
  if (there.count < kMinCount || there.sq_change < kMinChange) {
    return false;
  }
  double offset = 0.0;
  for (int i = 0; i < kIterations && there.sq_change > 0.0; ++i) {
    offset = std::clamp(offset + there.both / there.sq_change, -kMaxOffset, kMaxOffset);
    there = differences_at(history, turns, begin, offset);
  }
  if (there.count < kMinCount || !(there.sq_change > 0.0)) {
    return false;
  }
  const double degrees_of_freedom = 3.0 * static_cast<double>(there.count) - 4.0;
  const double variance =
      kLeastVariance + there.sq_difference / degrees_of_freedom / there.sq_change;
  const double time = turns.back().end;
  variance_ += kWander * kWander * (w_ > 0.0 ? std::max(0.0, time - time_) : 0.0);
  time_ = time;
  const double gain = variance_ / (variance_ + variance);
  left_ += gain * (offset - left_);
  variance_ *= 1.0 - gain;
  if (variance < kSure * kSure) {
    earliest_ = earliest_.value_or(mended_ + offset);
  }
  note(time, mended_ + offset, variance + hidden_variance(offset));
  return true;
}

void ClockWatch::note(double time, double offset, double variance) {
  first_ = w_ > 0.0 ? first_ : time;
  const double t = time - first_;
  const double weight = 1.0 / variance;
  w_ += weight;
  wt_ += weight * t;
  wo_ += weight * offset;
  wtt_ += weight * t * t;
  wto_ += weight * t * offset;
}

// Stretches before most of an offset was mended are unsure, and weigh little.
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
  return {mean - drift * mean_time, mean + drift * (time_ - first_ - mean_time)};
}

std::optional<double> ClockWatch::offset() const {
  constexpr double kLeast = 5e-4;  // [s]
  constexpr double kDeviations = 3.0;
  const bool is_sure = std::abs(left_) > kDeviations * std::sqrt(variance_);
  return is_sure && std::abs(left_) > kLeast ? std::optional<double>(left_) : std::nullopt;
}

void ClockWatch::mend(double offset) {
  mended_ += offset;
  earliest_ = earliest_.value_or(mended_);
  left_ -= offset;
  variance_ += hidden_variance(offset);
}

bool ClockWatch::was_late_at_first() const {
  constexpr double kShown = 0.15;  // at least: poses that lean on the IMU hide up to four fifths
  return earliest_ && *earliest_ * mended_ > kShown * mended_ * mended_;
}

std::string ClockWatch::finding() const {
  constexpr double kLeast = 0.0025;      // [s]
  constexpr double kLeastDrift = 0.004;  // over the run [s]
  const Line line = fit();
  if (mended_ != 0.0 && std::abs(line.end - line.begin) > kLeastDrift) {
    return drift_finding(line.begin, line.end);
  }
  if (std::abs(mended_) > kLeast) {
    return mended_offset_finding(mended_);
  }
  return offset() && std::abs(left_) > kLeast ? offset_finding(left_) : "";
}

}  // namespace nvm::lio
