// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/csv_reader.hpp"
#include "io/imu_gap_monitor.hpp"
#include "lio/sensor_data.hpp"

namespace nvm::io {

/// The samples of an imu.csv (t,gx,gy,gz,ax,ay,az in s, rad/s, m/s^2) in order of time. Throws
/// std::runtime_error, naming file and line, for numbers that are not finite, times that repeat or
/// go back, and gaps above `max_gap` [s].
class ImuFile {
 public:
  ImuFile(const std::string& path, double max_gap);

  /// The samples not yet handed out with time <= `time`.
  std::vector<lio::ImuSample> until(double time);

  /// The gaps among the samples handed out.
  const ImuGapMonitor& gaps() const { return gaps_; }

 private:
  void advance();

  CsvReader rows_;
  std::optional<lio::ImuSample> next_;
  ImuGapMonitor gaps_;
};

}  // namespace nvm::io
