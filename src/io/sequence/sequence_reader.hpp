// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/sensor_data.hpp"
#include "io/scan/point_times.hpp"
#include "io/sequence/message_clock.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm::io {

/// The unit of an IMU's accelerations.
enum class AccelUnit {
  kAutomatic,  ///< g when the first hundred samples have a median length below 3, else m/s^2
  kMetrePerSquareSecond,
  kStandardGravity,  ///< 9.80665 m/s^2, as Livox drivers give it
};

/// How to read what a recording does not tell itself.
struct SequenceOptions {
  std::string lidar_topic;  ///< of a bag; empty: the first one with point clouds
  std::string imu_topic;    ///< of a bag; empty: the first one with IMU messages
  AccelUnit accel_unit = AccelUnit::kAutomatic;  ///< of a bag
  TimeUnit point_time_unit = TimeUnit::kAutomatic;
  /// Field with the points' times, "azimuth" of raw scans of a spinning sensor, or "none"; empty:
  /// by its name, and for messages without one the azimuth
  std::string point_time_field;
  StampMeaning stamp = StampMeaning::kAutomatic;  ///< of a scan
  ClockChoice clock = ClockChoice::kAutomatic;    ///< of a bag
  /// Numbers a point in .bin files, 3 to 6; 0: as they look
  std::size_t bin_fields = 0;
  double scan_rate = 10.0;  ///< [Hz], 0.01 to 1000; of scan files without any time
  /// Extrinsic: x y z [m] qx qy qz qw; empty: what the sequence tells.
  std::vector<double> T_imu_lidar;
};

/// What is known of a sequence before its first scan is read.
struct SequenceInfo {
  std::string format;          ///< "folder of PCD files", "nvm sequence", "ROS 1 bag", ...
  std::string recording;       ///< whose messages come through a pipe; empty: what was opened
  std::size_t scan_count = 0;  ///< 0: unknown
  bool has_imu = false;
  bool has_point_times = false;
  bool has_T_imu_lidar = false;         ///< whether the sequence tells the extrinsic
  Pose T_imu_lidar = Pose::Identity();  ///< extrinsic; identity when the sequence does not tell
  /// What was taken off all points: the place of a scan in a map's coordinates [m]; zero in scans
  /// whose points lie around the sensor, as they should
  std::array<double, 3> origin{};
  std::vector<std::string> notes;       ///< what the user should know; grows while reading
  std::size_t skipped_scans = 0;        ///< so far: could not be read, repeat or go back in time
  std::size_t skipped_imu_samples = 0;  ///< so far, for the same reasons
};

/// Reads a recorded sequence one scan at a time, so that a sequence larger than memory can run.
class SequenceReader {
 public:
  virtual ~SequenceReader() = default;

  virtual const SequenceInfo& info() const = 0;

  /// The next scan in order of time; nothing at the end. Throws std::runtime_error, naming the
  /// file, when it is missing, truncated or malformed, and when scan times go back.
  virtual std::optional<Scan> next_scan() = 0;

  /// The IMU samples not yet handed out with time <= `time` [s], ascending; none without an IMU.
  /// Throws std::runtime_error, naming the file, when they are malformed or lack too long.
  virtual std::vector<ImuSample> imu_until(double time) = 0;
};

/// Opens a folder of PCD, PLY or KITTI .bin scans or one of them, an nvm sequence folder, or a ROS
/// 1 bag or a folder with the parts of one. Throws std::runtime_error, naming `path`, when it is
/// none of these, and std::invalid_argument for an option out of its range.
std::unique_ptr<SequenceReader> open_sequence(
    const std::string& path, const SequenceOptions& options = {});

}  // namespace nvm::io
