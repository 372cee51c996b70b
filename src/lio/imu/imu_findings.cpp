// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_findings.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "common/printed.hpp"
#include "lio/imu/is_about.hpp"

namespace nvm::lio {

namespace {

constexpr double kDegrees = 57.29577951308232;

/// As the options take it.
std::string setting_of(const Eigen::Matrix3d& R_body_lidar, const Eigen::Vector3d& p) {
  const Eigen::Quaterniond q(R_body_lidar);
  return printed(
      "input.T_imu_lidar=[%.3f, %.3f, %.3f, %.4f, %.4f, %.4f, %.4f]",
      p.x(),
      p.y(),
      p.z(),
      q.x(),
      q.y(),
      q.z(),
      q.w());
}

}  // namespace

std::string rotation_finding(const TurnComparison& turns, const Pose& T_body_lidar) {
  const Eigen::AngleAxisd turn(turns.rotation);
  return printed(
      "the LiDAR is turned against the IMU by %.0f degrees about (%.2f, %.2f, %.2f): their "
      "turn rates agree that way only, so T_imu_lidar is missing or wrong; the scans alone are "
      "used. Set %s%s",
      turn.angle() * kDegrees,
      turn.axis().x(),
      turn.axis().y(),
      turn.axis().z(),
      setting_of(turns.rotation.transpose() * T_body_lidar.linear(), T_body_lidar.translation())
          .c_str(),
      turns.is_about_one_axis
          ? " (the sensor turned about one axis alone: a turn about that axis is not known)"
          : "");
}

std::string small_rotation_finding(const Eigen::Matrix3d& rotation, const Pose& T_body_lidar) {
  const Eigen::AngleAxisd turn(rotation);
  return printed(
      "the LiDAR is turned by %.1f degrees about (%.2f, %.2f, %.2f) against where T_imu_lidar has "
      "it, for so do its turns against the gyroscope's. Set %s (imu.learn_rotation=false leaves "
      "it)",
      turn.angle() * kDegrees,
      turn.axis().x(),
      turn.axis().y(),
      turn.axis().z(),
      setting_of(rotation.transpose() * T_body_lidar.linear(), T_body_lidar.translation()).c_str());
}

std::string mirrored_scans_finding(const Eigen::Vector3d& normal) {
  return printed(
      "the scans are a mirror image along (%.2f, %.2f, %.2f): gyroscope and accelerometer agree "
      "with them that way only; the scans alone are used, and poses and map are mirrored. Turn "
      "that axis of the points round in the LiDAR's driver",
      std::abs(normal.x()),
      std::abs(normal.y()),
      std::abs(normal.z()));
}

std::string left_handed_finding(const Eigen::Matrix3d& reflection) {
  constexpr const char* kNames = "xyz";
  std::string axes;
  for (int row = 0; row < 3; ++row) {
    Eigen::Index column = 0;
    reflection.row(row).cwiseAbs().maxCoeff(&column);
    axes += row > 0 ? ", " : "";
    axes += reflection(row, column) < 0.0 ? "-" : "";
    axes += kNames[column];
  }
  return "the gyroscope turns as the scans do only if its axes are taken as (" + axes +
         "), which are left-handed: its driver turns one round, or swaps two; the scans alone are "
         "used. Mend the driver";
}

std::string gyro_scale_finding(double factor, double scale) {
  return printed(
      "the gyroscope turns by %.1f %% too %s for the scans: multiplied by %.4g (imu.gyro_scale "
      "sets another factor, or 1 for none)",
      100.0 * std::abs(1.0 / factor - 1.0),
      factor < 1.0 ? "much" : "little",
      scale);
}

std::string gyro_unit_finding(double times, double scale) {
  const char* unit = "a unit of its own";
  if (is_about(times, 57.3, 0.2)) {
    unit = "degrees per second";
  } else if (is_about(times, 1000.0, 0.2)) {
    unit = "milliradians per second";
  }
  return printed(
      "the gyroscope turns %.3g times as fast as the scans, so it measures in %s: multiplied by "
      "%.6g (imu.gyro_scale sets another factor)",
      times,
      unit,
      scale);
}

std::string accel_unit_finding(double force, double scale) {
  if (is_about(force, 1.0, 0.5)) {
    return printed(
        "the accelerometer measures in g, for it reads 1 where gravity is felt: multiplied by "
        "%.6g (imu.accel_scale sets another factor)",
        scale);
  }
  return printed(
      "the accelerometer reads %.4g where gravity is felt, in a unit of its own (milli-g, cm/s^2, "
      "counts): multiplied by %.4g (imu.accel_scale sets another factor)",
      force,
      scale);
}

std::string offset_finding(double offset) {
  return printed(
      "the IMU's clock is %.0f ms %s: the scans turn when the gyroscope does only if "
      "imu.time_offset=%.3f is set",
      1e3 * std::abs(offset),
      offset > 0.0 ? "late" : "early",
      -offset);
}

std::string mended_offset_finding(double offset) {
  return printed(
      "the IMU's clock is %.1f ms %s, for the gyroscope turns then and the scans do not: its times "
      "are mended (imu.time_offset=%.4f does so from the beginning, "
      "imu.learn_time_offset=false leaves them)",
      1e3 * std::abs(offset),
      offset > 0.0 ? "late" : "early",
      -offset);
}

std::string drift_finding(double first, double last) {
  return printed(
      "the IMU's clock drifts: it was %.0f ms late at first and %.0f ms in the end (negative: "
      "early). Its times are mended; let both sensors have one clock (PTP, PPS)",
      1e3 * first,
      1e3 * last);
}

std::string gravity_finding(double felt, double gravity) {
  return printed(
      "the accelerometer feels %.2f m/s^2 of gravity, not %.2f: its driver removes gravity, "
      "swaps accelerations and turn rates, or sends none; the scans alone are used. Record raw "
      "accelerations, or set imu.accel_scale",
      felt,
      gravity);
}

std::string mirror_finding() {
  return "the accelerometer goes against the scans' motion, but not with all of its axes: one is "
         "turned round, or they are swapped; the scans alone are used. Set imu.accel_scale=-1 if "
         "all have the wrong sign";
}

std::string contradiction_finding(std::size_t times, double first, bool still) {
  return printed(
      "scans lay elsewhere than the IMU had led the pose (times: %zu, first at "
      "%.1f s): the scans alone were used from there%s. Check that it is this LiDAR's IMU, its "
      "axes (input.T_imu_lidar) and its clock",
      times,
      first,
      still ? " to the end" : " until both told the same motion again");
}

std::string clipping_finding(
    const char* sensor, const char* unit, const ImuClipping::Axis& axis, double scale) {
  return printed(
      "the %s never reads more than %.3g %s about %c, where %.0f %% of its readings stand: what "
      "lies beyond its range is cut off; the scans alone are used. Set a larger range in its "
      "driver",
      sensor,
      std::abs(scale) * axis.limit,
      unit,
      "xyz"[axis.index],
      100.0 * axis.share);
}

std::string late_start_finding(double seconds, bool moved) {
  return printed(
      "%s: the poses of the first %.1f s are those of the scans alone, which are less exact%s",
      moved ? "the recording begins in motion" : "the IMU's readings begin later than the scans",
      seconds,
      moved ? ". Let the sensor rest for a second at the start" : "");
}

std::string early_end_finding(double seconds) {
  return printed(
      "the IMU's readings end %.1f s before the scans: from there the poses rest on the scans "
      "alone, and are less exact",
      seconds);
}

std::string frozen_finding(
    const char* sensor, const char* unit, const ImuClipping::Axis& axis, double scale) {
  return printed(
      "the %s's %c axis reads %.3g %s in %.0f %% of the readings, whatever the others do: it is "
      "dead, "
      "or its driver leaves it out; the scans alone were used. Mend the driver",
      sensor,
      "xyz"[axis.index],
      scale * axis.limit,
      unit,
      100.0 * axis.share);
}

std::string left_out_finding(const ImuBufferStats& stats) {
  const std::size_t count = stats.non_finite + stats.implausible;
  if (count == 0) {
    return "";
  }
  const std::string longest = stats.longest_outage > 0.0
                                  ? printed(
                                        "; the longest such time is %.3f s at t = %.3f s",
                                        stats.longest_outage,
                                        stats.outage_begin)
                                  : "";
  return printed(
      "%zu IMU readings are left out: they are not finite, beyond any IMU, or leap away, fall to "
      "zero or stand still as no motion does%s. The motion is bridged there; look at the IMU's "
      "cable and driver",
      count,
      longest.c_str());
}

}  // namespace nvm::lio
