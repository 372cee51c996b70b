// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/deskew.hpp"

#include <cmath>

#include "lio/scan/scan_thinning.hpp"
#include "nvm/core/require.hpp"

namespace nvm::lio {

namespace {

/// A segment's motion expressed in the scan frame: p_scan = turn Exp(rate s) p_body + offset +
/// velocity s + half_acceleration s^2, with s [s] since the segment's beginning.
struct ScanFrameMotion {
  Eigen::Matrix3d turn;
  Eigen::Vector3d rate, offset, velocity, half_acceleration;

  ScanFrameMotion(const MotionSegment& segment, const NavState& end) {
    const Pose T_scan_world = end.T_world_lidar().inverse();
    const Eigen::Matrix3d R = T_scan_world.linear();
    turn = R * segment.T_world_body.linear();
    rate = segment.rate;
    offset = T_scan_world * segment.T_world_body.translation();
    velocity = R * segment.velocity;
    half_acceleration = 0.5 * (R * segment.acceleration);
  }

  Eigen::Vector3d shift(double s) const {
    return offset + s * velocity + (s * s) * half_acceleration;
  }

  /// Exp to second order: between two readings the angle stays below 0.05 rad.
  Eigen::Vector3d turned(const Eigen::Vector3d& p_body, double s) const {
    const Eigen::Vector3d angle = s * rate;
    const Eigen::Vector3d once = angle.cross(p_body);
    return turn * (p_body + once + 0.5 * angle.cross(once));
  }
};

}  // namespace

void DeskewedScan::clear() {
  points.clear();
  viewpoints.clear();
  ages.clear();
  values.clear();
}

DeskewStats deskew(
    const Scan& scan,
    const std::vector<MotionSegment>& segments,
    const NavState& end,
    const ReturnLimits& limits,
    DeskewedScan& out) {
  DeskewStats stats;
  out.clear();
  const Eigen::Matrix3d R_body_lidar = end.T_body_lidar.linear();
  const Eigen::Vector3d lidar_body = end.T_body_lidar.translation();
  std::size_t current = 0;
  ScanFrameMotion motion(segments.front(), end);
  ScanThinning thinning(scan, limits);
  for (const TimedPoint& point : scan.points) {
    const float sq_range = point.sq_range();
    if (!std::isfinite(sq_range) || !std::isfinite(point.dt)) {
      ++stats.non_finite;
      continue;
    }
    if (!limits.contain(sq_range)) {
      ++stats.out_of_range;
      continue;
    }
    if (!thinning.keeps(sq_range)) {
      continue;
    }
    const double time = scan.t_begin + static_cast<double>(point.dt);
    const std::size_t before = current;
    while (current + 1 < segments.size() && segments[current + 1].time <= time) {
      ++current;
    }
    if (current != before) {
      motion = ScanFrameMotion(segments[current], end);
    }
    const double s = time - segments[current].time;
    const Eigen::Vector3d shift = motion.shift(s);
    const Eigen::Vector3d p_body =
        R_body_lidar * Eigen::Vector3d(point.x, point.y, point.z) + lidar_body;
    out.points.emplace_back((motion.turned(p_body, s) + shift).cast<float>());
    out.viewpoints.emplace_back((motion.turned(lidar_body, s) + shift).cast<float>());
    out.ages.push_back(static_cast<float>(end.time - time));
    PointValues& values = out.values.emplace_back();
    values.intensity = point.intensity;
    values.time = time;
  }
  return stats;
}

void correct_deskew(const NavState& predicted, const NavState& corrected, DeskewedScan& scan) {
  const Eigen::Matrix3d R_lidar_body = corrected.T_body_lidar.linear().transpose();
  const Eigen::Vector3d dv_body = corrected.T_world_body.linear().transpose() * corrected.velocity -
                                  predicted.T_world_body.linear().transpose() * predicted.velocity;
  const Eigen::Vector3f dv = (R_lidar_body * dv_body).cast<float>();
  const Eigen::Vector3f dw =
      (R_lidar_body * (corrected.gyro_bias - predicted.gyro_bias)).cast<float>();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float age = scan.ages[i];
    scan.points[i] += age * (dw.cross(scan.points[i]) - dv);
    scan.viewpoints[i] += age * (dw.cross(scan.viewpoints[i]) - dv);
  }
}

void ReturnLimits::validate() const {
  require(min_range >= 0.0, "min_range", min_range, "0 or more [m]");
  require(
      max_range > min_range && std::isfinite(max_range),
      "max_range",
      max_range,
      "larger than min_range [m]");
  require(max_count >= 1, "max_count", max_count, "1 or more");
}

}  // namespace nvm::lio
