// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "common/sensor_data.hpp"
#include "lio/imu/imu_outliers.hpp"

namespace nvm::lio {

/// What became of the IMU readings given to an ImuBuffer.
struct ImuBufferStats {
  std::size_t accepted = 0;
  std::size_t late = 0;        ///< older than what was already used, dropped
  std::size_t repeated = 0;    ///< same time as another reading, dropped
  std::size_t non_finite = 0;  ///< NaN or inf, dropped
  std::size_t implausible =
      0;  ///< beyond what an IMU measures, or off as ImuOutliers says, dropped
  /// The longest time without good readings that those took [s], and when it began.
  double longest_outage = 0.0, outage_begin = 0.0;
};

/// The recent IMU readings in order of time. Readings may arrive out of order as long as the time
/// they belong to has not been used yet.
class ImuBuffer {
 public:
  void add(const ImuSample& sample);

  /// The readings that describe the motion from `begin` to `end` [s]: those in between, and one at
  /// each border, interpolated between its two neighbours. A border without a neighbour on one side
  /// repeats the nearest reading when that is at most `max_gap` [s] away, and is left out
  /// otherwise. Readings that are off are left out; such as may yet turn out to be a jolt, until
  /// they do. Replaces `out`, ascending by time.
  void between(double begin, double end, double max_gap, std::vector<ImuSample>& out) const;

  /// Forgets all but a few readings before `time` [s], and refuses such from now on.
  void use_until(double time);

  /// Moves all readings, and what has been used of them, by a time [s].
  void move(double by);

  /// Whether two or more readings on end have been left out between `begin` and `end` [s]: they may
  /// have been a jolt.
  bool is_doubtful(double begin, double end) const;

  /// Typical time between the readings of late [s]: their median, 0 before the second.
  double interval() const;

  const ImuBufferStats& stats() const { return stats_; }

 private:
  void append(const ImuSample& sample);
  void accept(const ImuSample& sample);
  void drop_doubtful(double now);
  void note_interval(double interval);

  struct Span {
    double begin, end;  ///< [s]
  };

  std::deque<ImuSample> samples_;
  ImuOutliers outliers_;
  std::vector<ImuSample> doubtful_;  ///< after all samples: off, so far
  std::deque<Span> doubts_;          ///< where is_doubtful()
  double used_until_ = -1e300;
  std::deque<double> intervals_;  ///< of late [s]
  ImuBufferStats stats_;
};

/// The reading a share of the way from `a` to `b` that belongs to `time` [s].
ImuSample interpolate(const ImuSample& a, const ImuSample& b, double time);

}  // namespace nvm::lio
