// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace nvm::io {

/// The unit of a point's time field.
enum class TimeUnit {
  kAutomatic,
  kSecond,
  kMillisecond,
  kMicrosecond,
  kNanosecond,
  kSweep,  ///< 0 to 1 from the sweep's begin to its end
};

/// From the stamp to the points of a scan in the same clock, at most [s].
constexpr double kMaxStampOffset = 10.0;

/// What the stamp of a scan dates.
enum class StampMeaning { kAutomatic, kBegin, kEnd };

/// What is known beforehand of how a sensor dates its points.
struct PointTimeOptions {
  std::string field;  ///< name of the time field, "azimuth" or "none"; empty: automatic
  TimeUnit unit = TimeUnit::kAutomatic;
  StampMeaning stamp = StampMeaning::kAutomatic;
  /// Points as the sensor gave them: without times, the azimuth tells them.
  bool is_raw = false;
  /// Stamps that were made up: any absolute time of a point is better.
  bool has_assumed_stamps = false;
};

/// What one scan tells of how a sensor dates its points.
struct SweepSample {
  double stamp = 0.0;  ///< [s]
  /// When the message was recorded [s], in the clock of `stamp` up to a delay; NaN: unknown.
  double record_time = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> ticks;  ///< times of some of its returns, ascending; empty without times
};

/// The form in which a time field is stored.
struct TickType {
  bool is_whole = false;
  double modulus = 0.0;     ///< 2^16 or 2^32 for whole numbers that wrap there, else 0
  double resolution = 0.0;  ///< between neighbouring ticks at unit size: 2^-23 of float32, else 0
};

/// How a sensor dates its points and scans.
struct PointTimes {
  enum class Base {
    kNone,        ///< there are no times
    kStamp,       ///< they count from a scan's stamp
    kAbsolute,    ///< they are in the clock of the stamps
    kOtherClock,  ///< they only tell differences
  };

  Base base = Base::kNone;
  double seconds_per_tick = 1.0;
  double period = 0.1;  ///< from scan to scan [s]
  double begin = 0.0;   ///< kStamp: typical time of a sweep's first point [s]
  double end = 0.0;     ///< typical time of its last point, after `begin` for other bases [s]
  double max_duration = 0.15;  ///< points further apart have wrong times [s]
  bool is_stamp_at_end = false;
  std::string problem;      ///< why times that are there are of no use; empty
  std::string description;  ///< for the user: unit, base, stamp

  /// The time [s] of a sweep's begin by its stamp alone.
  double sweep_begin(double stamp) const { return is_stamp_at_end ? stamp - end : stamp; }
};

/// Learns from the first scans, in order. Outliers among the points and among the scans do not
/// matter while they are fewer than half.
///
/// Unit: of s (not for whole numbers), ms, us, ns the one that makes a scan last nearest to 0.1 s,
/// or to the interval between scans if that is less, on a logarithmic scale. When a scan would last
/// longer than from scan to scan, its times are fractions of the sweep (0 to 1). Base: kStamp when
/// times are near zero and repeat from scan to scan, kAbsolute when near the stamp or an epoch.
/// The stamp is the sweep's end when messages were recorded before their sweep could have ended.
PointTimes learn_point_times(
    const std::vector<SweepSample>& samples, const TickType& type, const PointTimeOptions& options);

}  // namespace nvm::io
