// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"
#include "io/cloud/point_records.hpp"
#include "io/scan/point_times.hpp"

namespace nvm::io {

/// Points and when they say, or a message says, that they were measured.
struct CloudMessage {
  double stamp = 0.0;  ///< [s]
  PointRecords records;
  double record_time = std::numeric_limits<double>::quiet_NaN();  ///< [s]; NaN: unknown
  std::string frame = {};                                         ///< the header's frame_id
};

/// Turns point records into scans. Keeps what it learnt of their times for the scans to come.
class ScanConverter {
 public:
  explicit ScanConverter(PointTimeOptions options = {}) : options_(std::move(options)) {}

  /// Learns how points and scans are dated (learn_point_times) from the first ones, in order, and
  /// says so in notes(). Without this call, the first scan of convert() is all it learns from.
  void learn(const std::vector<CloudMessage>& clouds);

  /// The scan of `records`, which the file or message dates `stamp` [s].
  ///
  /// Fields: x y z [m]; intensity (or reflectivity); a time field; ring (or line, channel). Points
  /// without a position ("no return": not finite, or all zero), or with a time that is not finite,
  /// are left out, the others sorted by time. Times that do not fit into a sweep are mended where
  /// the counter wrapped, else their points are left out; when that would be half of a scan,
  /// its times are replaced by the azimuth's, or all are put to its begin. Both are counted.
  ///
  /// Throws std::runtime_error, naming the source, without x y z or with a time field that is
  /// asked for and not there.
  Scan convert(const PointRecords& records, double stamp);
  /// Clouds that will come again, without counting what is wrong with them; those that cannot be
  /// converted are left out.
  std::vector<Scan> preview(const std::vector<CloudMessage>& clouds) const;

  const PointTimes& times() const { return times_; }

  /// What is taken off all points [m]: map_origin() of the first scan.
  const std::array<double, 3>& origin() const { return origin_; }
  bool has_point_times() const { return times_.base != PointTimes::Base::kNone || uses_azimuth_; }

  /// What was inferred and what was left out, for the user; grows with the scans.
  std::vector<std::string> notes() const;

 private:
  const Field* time_field(const PointRecords& records) const;
  SweepSample sample_of(const CloudMessage& cloud) const;
  void set_times(std::vector<double>& ticks, double stamp, Scan& scan);
  void mend_times(std::vector<double>& ticks, Scan& scan);
  bool set_times_by_azimuth(double stamp, Scan& scan) const;
  bool is_plausible(double first, double last, double stamp) const;

  PointTimeOptions options_;
  PointTimes times_;
  std::array<double, 3> origin_{};
  double modulus_ = 0.0;  ///< of the time field
  bool has_learnt_ = false;
  bool uses_azimuth_ = false;
  std::string field_;              ///< the time field
  std::string source_;             ///< for notes
  std::size_t wrong_times_ = 0;    ///< points left out for their times
  std::size_t untimed_scans_ = 0;  ///< scans whose times were replaced
};

}  // namespace nvm::io
