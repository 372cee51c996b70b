// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"
#include "io/file/csv_reader.hpp"
#include "io/sequence/imu_gap_monitor.hpp"
#include "io/sequence/left_out.hpp"

namespace nvm::io {

/// The samples of an imu.csv (t,gx,gy,gz,ax,ay,az in s, rad/s, m/s^2) in order of time, which rows
/// may leave by up to half a second. Times may be in another unit, which their steps tell
/// (time_unit.hpp). Rows that are no sample (not seven finite numbers, absurd ones, a time that
/// repeats or goes farther back) are left out. Throws std::runtime_error, naming the file, when it
/// lacks a column.
class ImuFile {
 public:
  explicit ImuFile(const std::string& path);

  /// The samples not yet handed out with time <= `time`.
  std::vector<ImuSample> until(double time);

  /// Of the times in the file [s].
  double unit() const { return unit_; }

  /// The gaps among the samples handed out.
  const ImuGapMonitor& gaps() const { return gaps_; }

  /// The rows that were left out so far.
  const LeftOut& bad_rows() const { return bad_rows_; }

  /// That rows were not in order of time; nothing when they were.
  std::optional<std::string> order_note() const;

 private:
  void read_ahead();
  void take(const ImuSample& sample);
  std::optional<ImuSample> read_row();

  double unit_;
  CsvReader rows_;
  bool has_ended_ = false;
  std::map<double, ImuSample> ahead_;  ///< read and not yet handed out, by time
  std::size_t disordered_ = 0;         ///< rows
  ImuGapMonitor gaps_;
  LeftOut bad_rows_{"rows of imu.csv are"};
  double handed_out_ = -std::numeric_limits<double>::infinity();  ///< time of the last [s]
};

/// Nothing when the readings are such as an IMU may give, in any unit in use; else what is wrong.
std::optional<std::string> problem_of(const ImuSample& sample);

}  // namespace nvm::io
