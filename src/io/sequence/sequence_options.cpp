// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/sequence_options.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "config/schema.hpp"

namespace nvm::io {

void bind(config::Schema& schema, SequenceOptions& options) {
  schema.add(
      "lidar_topic",
      options.lidar_topic,
      "The topic of the point clouds; when empty, the first of a bag that has them");
  schema.add(
      "imu_topic",
      options.imu_topic,
      "The topic of the IMU; when empty, the first of a bag that has its messages");
  schema.add_choice<AccelUnit>(
      "accel_unit",
      options.accel_unit,
      {{"auto", AccelUnit::kAutomatic},
       {"m/s2", AccelUnit::kMetrePerSquareSecond},
       {"g", AccelUnit::kStandardGravity}},
      "The unit of accelerations in a bag");
  schema.add_choice<TimeUnit>(
      "point_time_unit",
      options.point_time_unit,
      {{"auto", TimeUnit::kAutomatic},
       {"s", TimeUnit::kSecond},
       {"ms", TimeUnit::kMillisecond},
       {"us", TimeUnit::kMicrosecond},
       {"ns", TimeUnit::kNanosecond},
       {"sweep", TimeUnit::kSweep}},
      "The unit of the points' times; with sweep they go from 0 to 1 between its begin and end");
  schema.add(
      "point_time_field",
      options.point_time_field,
      "The name of the points' time field, found when empty; azimuth takes the times from the "
      "angles "
      "of a spinning sensor, none takes no times");
  schema.add_choice<StampMeaning>(
      "stamp",
      options.stamp,
      {{"auto", StampMeaning::kAutomatic},
       {"begin", StampMeaning::kBegin},
       {"end", StampMeaning::kEnd}},
      "Whether a scan's stamp dates the begin or the end of its sweep");
  schema.add_choice<ClockChoice>(
      "clock",
      options.clock,
      {{"auto", ClockChoice::kAutomatic},
       {"header", ClockChoice::kHeader},
       {"record", ClockChoice::kRecord}},
      "Whether a bag's messages are dated by their headers or by their recording");
  schema.add(
      "bin_fields",
      options.bin_fields,
      {0.0, 6.0},
      "A point in .bin files has this many numbers; with 0 as many as it looks like");
  schema.add(
      "scan_rate",
      options.scan_rate,
      {0.01, 1000.0},
      "Files without any time are this many scans a second [Hz]");
  schema.add(
      "T_imu_lidar",
      options.T_imu_lidar,
      "The LiDAR in the IMU's frame, as x y z [m] qx qy qz qw; when empty, as the sequence tells");
}

Pose extrinsic(const SequenceOptions& options, const Pose& otherwise) {
  const std::vector<double>& numbers = options.T_imu_lidar;
  if (numbers.empty()) {
    return otherwise;
  }
  constexpr double kMaxLengthError = 0.01;
  if (numbers.size() == 7) {
    const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
    if (std::abs(q.norm() - 1.0) <= kMaxLengthError) {
      Pose pose = Pose::Identity();
      pose.linear() = q.normalized().toRotationMatrix();
      pose.translation() << numbers[0], numbers[1], numbers[2];
      return pose;
    }
  }
  throw std::invalid_argument(
      "input.T_imu_lidar must be seven numbers x y z qx qy qz qw with a unit quaternion");
}

PointTimeOptions point_time_options(const SequenceOptions& options) {
  PointTimeOptions times;
  times.field = options.point_time_field;
  times.unit = options.point_time_unit;
  times.stamp = options.stamp;
  return times;
}

PointTimeOptions message_time_options(const SequenceOptions& options) {
  PointTimeOptions times = point_time_options(options);
  times.is_raw = true;
  return times;
}

double accel_scale(std::vector<double> norms, AccelUnit unit) {
  constexpr double kStandardGravity = 9.80665;
  constexpr double kNoGravity = 0.5;  // less is noise of an IMU that gives none in either unit
  constexpr double kLimit = 3.0;      // between 1 g and 9.8 m/s^2 on a logarithmic scale
  if (unit == AccelUnit::kAutomatic && !norms.empty()) {
    std::sort(norms.begin(), norms.end());
    const double norm = norms[norms.size() / 2];
    unit = norm > kNoGravity && norm < kLimit ? AccelUnit::kStandardGravity
                                              : AccelUnit::kMetrePerSquareSecond;
  }
  return unit == AccelUnit::kStandardGravity ? kStandardGravity : 1.0;
}

}  // namespace nvm::io
