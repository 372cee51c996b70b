// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "io/point_records.hpp"
#include "lio/sensor_data.hpp"

namespace nvm::io {

/// The unit of a point's time field.
enum class TimeUnit { kAutomatic, kSecond, kMillisecond, kMicrosecond, kNanosecond };

/// The field with the points' times: time, t, timestamp, offset_time or time_stamp; nullptr
/// without.
const Field* find_time_field(const PointRecords& records);

/// Turns point records into scans. Keeps what it learnt of the time unit for the scans to come.
class ScanConverter {
 public:
  explicit ScanConverter(TimeUnit unit = TimeUnit::kAutomatic) : unit_(unit) {}

  /// The scan of `records`, which the file or message dates `stamp` [s].
  ///
  /// Fields: x y z [m]; intensity (or reflectivity); a time field; ring (or line, channel). Points
  /// with a coordinate or time that is not finite ("no return") are left out, and the others sorted
  /// by time. kAutomatic takes the unit that makes the duration of the first scan nearest to 0.1 s
  /// on a logarithmic scale (whole numbers are never seconds).
  ///
  /// The first point's time is absolute when it is within 10 s of the stamp and nearer to it than
  /// to zero, or above 1e8 s (three years); else relative to the stamp when within 10 s of zero;
  /// any other clock only tells the points' differences, and the first point gets the stamp.
  ///
  /// Throws std::runtime_error, naming the source, without x y z.
  lio::Scan convert(const PointRecords& records, double stamp);

 private:
  void set_times(const std::vector<double>& ticks, bool is_whole, lio::Scan& scan);

  TimeUnit unit_;
};

}  // namespace nvm::io
