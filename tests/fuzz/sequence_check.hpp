// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>
#include <limits>

#include "fuzz_target.hpp"
#include "io/sequence/sequence_reader.hpp"

namespace nvm::fuzz {

/// Reads a sequence to its end and requires what its readers promise.
inline void read_all(io::SequenceReader& reader) {
  double previous_begin = -std::numeric_limits<double>::infinity();
  double previous_imu = previous_begin;
  while (const auto scan = reader.next_scan()) {
    require(std::isfinite(scan->t_begin) && std::isfinite(scan->t_end), "scans have finite times");
    require(scan->t_end >= scan->t_begin, "a scan ends after its begin");
    require(scan->t_begin > previous_begin, "scans are in order of time");
    previous_begin = scan->t_begin;
    float previous = 0.0F;
    for (const TimedPoint& point : scan->points) {
      require(
          std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z),
          "positions are finite");
      require(point.dt >= previous, "points are in order of time");
      previous = point.dt;
    }
    for (const ImuSample& sample : reader.imu_until(scan->t_end)) {
      require(sample.time > previous_imu, "IMU samples are in order of time");
      require(sample.time <= scan->t_end, "no IMU sample comes too early");
      require(sample.gyro.allFinite() && sample.accel.allFinite(), "IMU samples are finite");
      previous_imu = sample.time;
    }
  }
}

}  // namespace nvm::fuzz
