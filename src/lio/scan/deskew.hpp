// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "common/sensor_data.hpp"
#include "lio/state/motion_segment.hpp"
#include "lio/state/nav_state.hpp"
#include "nvm/map/point_values.hpp"

namespace nvm::lio {

/// A scan as if every return had been measured from the LiDAR frame at the scan's end, the "scan
/// frame". All vectors have one element per kept return, in order of time.
struct DeskewedScan {
  std::vector<Eigen::Vector3f> points;      ///< [m], scan frame
  std::vector<Eigen::Vector3f> viewpoints;  ///< where the LiDAR was then [m], scan frame
  std::vector<float> ages;                  ///< scan end - time of the return [s]
  std::vector<PointValues> values;          ///< its intensity and time

  std::size_t size() const { return points.size(); }
  void clear();
};

/// Which returns of a scan are used.
struct ReturnLimits {
  double min_range = 0.3;          ///< [m]
  double max_range = 100.0;        ///< [m]
  std::size_t max_count = 60'000;  ///< about; the densest of a larger scan are thinned, at least 1

  /// Whether a squared range [m^2] lies between the two; not a number does not.
  bool contain(float sq_range) const {
    return sq_range >= static_cast<float>(min_range * min_range) &&
           sq_range <= static_cast<float>(max_range * max_range);
  }
  void validate() const;
};

/// Returns left out by deskew(), those that are thinned aside.
struct DeskewStats {
  std::size_t non_finite = 0;
  std::size_t out_of_range = 0;
};

/// Moves each return of `scan` to the scan frame by the pose at its own time. `segments`: the
/// motion up to `end`, ascending and not empty; times before the first segment extrapolate it.
/// Replaces `out`, whose memory is reused.
DeskewStats deskew(
    const Scan& scan,
    const std::vector<MotionSegment>& segments,
    const NavState& end,
    const ReturnLimits& limits,
    DeskewedScan& out);

/// Turns a scan deskewed with `predicted` into what it would have been with `corrected`, both
/// states at the scan's end, to first order in their difference of velocity and gyro bias.
void correct_deskew(const NavState& predicted, const NavState& corrected, DeskewedScan& scan);

}  // namespace nvm::lio
