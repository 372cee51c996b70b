// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>

#include "lio/imu/imu_buffer.hpp"
#include "lio/imu/imu_clipping.hpp"
#include "lio/imu/turn_comparison.hpp"
#include "nvm/geometry/pose.hpp"

namespace nvm::lio {

// What is said of an IMU, a line each: what was seen, what it usually means, what mends it.

/// `T_body_lidar` is the extrinsic that the poses take for granted.
std::string rotation_finding(const TurnComparison& turns, const Pose& T_body_lidar);
/// Of one by some degrees.
std::string small_rotation_finding(const Eigen::Matrix3d& rotation, const Pose& T_body_lidar);

/// Of scans that are a mirror image; `normal` of the mirror, body frame.
std::string mirrored_scans_finding(const Eigen::Vector3d& normal);

/// Of a gyroscope that turns as the scans do once its readings are multiplied by `reflection`.
std::string left_handed_finding(const Eigen::Matrix3d& reflection);

/// Of a gyroscope whose readings need a `factor`, and are multiplied by `scale` in all.
std::string gyro_scale_finding(double factor, double scale);

/// Of a gyroscope that turns `times` as fast as the scans, and is multiplied by `scale`.
std::string gyro_unit_finding(double times, double scale);

/// Of an accelerometer that reads `force` where gravity is felt, and is multiplied by `scale`.
std::string accel_unit_finding(double force, double scale);

/// `offset` [s] as in TurnComparison.
std::string offset_finding(double offset);
/// Of one that was mended.
std::string mended_offset_finding(double offset);
/// Of one that was `first` and `last` [s], and was mended.
std::string drift_finding(double first, double last);

/// `felt` and `gravity` [m/s^2].
std::string gravity_finding(double felt, double gravity);

/// Of an accelerometer.
std::string mirror_finding();

/// `times` the scans alone went on, for the `first` so long [s] after the first scan, and do
/// `still`.
std::string contradiction_finding(std::size_t times, double first, bool still);

/// Of scans that were used alone for the first `seconds`, for the sensor `moved` or for want of
/// readings.
std::string late_start_finding(double seconds, bool moved);

/// Of readings that end `seconds` before the scans do.
std::string early_end_finding(double seconds);

/// Of an axis that reads nothing but `axis.limit`; `scale` makes `unit` of it.
std::string frozen_finding(
    const char* sensor, const char* unit, const ImuClipping::Axis& axis, double scale);

/// `scale` makes `unit` of the readings.
std::string clipping_finding(
    const char* sensor, const char* unit, const ImuClipping::Axis& axis, double scale);

/// Of readings that were left out; empty without any.
std::string left_out_finding(const ImuBufferStats& stats);

}  // namespace nvm::lio
