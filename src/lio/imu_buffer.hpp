// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "lio/sensor_data.hpp"

namespace nvm::lio {

/// What became of the IMU readings given to an ImuBuffer.
struct ImuBufferStats {
  std::size_t accepted = 0;
  std::size_t late = 0;        ///< older than what was already used, dropped
  std::size_t repeated = 0;    ///< same time as another reading, dropped
  std::size_t non_finite = 0;  ///< NaN or inf, dropped
  /// Beyond what an IMU measures, or single readings far off both their neighbours, dropped.
  std::size_t implausible = 0;
};

/// The recent IMU readings in order of time. Readings may arrive out of order as long as the time
/// they belong to has not been used yet.
class ImuBuffer {
 public:
  void add(const ImuSample& sample);

  /// The readings that describe the motion from `begin` to `end` [s]: those in between, and one at
  /// each border, interpolated between its two neighbours. A border without a neighbour on one side
  /// repeats the nearest reading when that is at most `max_gap` [s] away, and is left out
  /// otherwise. The last reading of all is left out while it may be a spike. Replaces `out`,
  /// ascending by time.
  void between(double begin, double end, double max_gap, std::vector<ImuSample>& out) const;

  /// Forgets all but a few readings before `time` [s], and refuses such from now on.
  void use_until(double time);

  /// True when a reading at or after `time` [s] has arrived.
  bool covers(double time) const { return !samples_.empty() && samples_.back().time >= time; }

  /// Typical time between the readings of late [s]: their median, 0 before the second.
  double interval() const;

  const ImuBufferStats& stats() const { return stats_; }

 private:
  void append(const ImuSample& sample);
  bool is_last_doubtful() const;
  void note_interval(double interval);

  std::deque<ImuSample> samples_;
  double used_until_ = -1e300;
  std::deque<double> intervals_;  ///< of late [s]
  ImuBufferStats stats_;
};

/// The reading a share of the way from `a` to `b` that belongs to `time` [s].
ImuSample interpolate(const ImuSample& a, const ImuSample& b, double time);

}  // namespace nvm::lio
