// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "lio/analytic_motion.hpp"
#include "lio/pipeline/pipeline.hpp"
#include "support/room.hpp"

namespace nvm::test {

/// Scans and IMU readings of a sensor that sways through the test room, and a way to run them.
struct RoomRecording {
  struct Gap {
    double begin = 0.0;  ///< [s]
    double end = 0.0;
    bool contains(double t) const { return t >= begin && t < end; }
  };

  AnalyticMotion motion;
  double duration = 6.0;     ///< [s]
  double scan_period = 0.1;  ///< [s]
  std::size_t points_per_scan = 3000;
  double range_noise = 0.01;  ///< [m]
  Gap scan_gap, imu_gap;      ///< scans and readings inside are left out
  double imu_step = 0.005;    ///< between readings [s]
  /// What the IMU sends instead of a true reading.
  std::function<ImuSample(const ImuSample&)> sent = [](const ImuSample& sample) { return sample; };
  /// Which returns the sensor sees, by their place in the room [m].
  std::function<bool(const Eigen::Vector3d& p_map)> sees = [](const Eigen::Vector3d&) {
    return true;
  };

  Scan scan(int index) const {
    std::mt19937_64 rng(static_cast<std::uint64_t>(index));
    const Room room;
    Scan scan{index * scan_period, (index + 1) * scan_period, {}};
    for (std::size_t i = 0; i < points_per_scan; ++i) {
      const double dt = scan_period * static_cast<double>(i) / static_cast<double>(points_per_scan);
      const Pose T_map_scan = motion.pose(scan.t_begin + dt);
      const Eigen::Vector3f p = room.scan(T_map_scan, 1, range_noise, rng).points[0];
      if (sees(T_map_scan * p.cast<double>())) {
        scan.points.push_back({p.x(), p.y(), p.z(), 0.0F, static_cast<float>(dt), 0});
      }
    }
    return scan;
  }

  int scan_count() const { return static_cast<int>(std::lround(duration / scan_period)); }

  /// The readings that come before scan `index` is complete and after the one before.
  std::vector<ImuSample> imu(int index) const {
    const auto first_after = [&](int scan) {
      return scan < 0 ? 0
                      : static_cast<int>(std::ceil(((scan + 1) * scan_period + 0.01) / imu_step));
    };
    std::vector<ImuSample> samples;
    for (int i = first_after(index - 1); i < first_after(index); ++i) {
      if (!imu_gap.contains(i * imu_step)) {
        samples.push_back(sent(motion.imu(i * imu_step)));
      }
    }
    return samples;
  }

  /// Feeds scan `index`, changed by `change`, and the readings before it.
  lio::FrameResult feed(
      lio::Pipeline& pipeline, int index, const std::function<void(Scan&)>& change = [](Scan&) {
      }) const {
    for (const ImuSample& sample : imu(index)) {
      pipeline.add_imu(sample);
    }
    Scan next = scan(index);
    change(next);
    return pipeline.process(next);
  }

  /// Feeds everything; returns what the pipeline said about each scan.
  std::vector<lio::FrameResult> run(lio::Pipeline& pipeline) const {
    std::vector<lio::FrameResult> results;
    for (int i = 0; i < scan_count(); ++i) {
      if (!scan_gap.contains(i * scan_period)) {
        results.push_back(feed(pipeline, i));
      } else {
        for (const ImuSample& sample : imu(i)) {
          pipeline.add_imu(sample);
        }
      }
    }
    return results;
  }

  /// Distance [m] of a pose to the truth. The map frame is the first body frame, levelled: the
  /// motion starts there with the identity.
  double error(const lio::FrameResult& result) const {
    return (result.T_map_body.translation() - motion.pose(result.time).translation()).norm();
  }

  /// The same between the ways from one pose to another, whatever the map frame: in the first
  /// body's frame.
  double error_since(const lio::FrameResult& first, const lio::FrameResult& last) const {
    const Pose estimated = first.T_map_body.inverse() * last.T_map_body;
    const Pose truth = motion.pose(first.time).inverse() * motion.pose(last.time);
    return (estimated.translation() - truth.translation()).norm();
  }
};

}  // namespace nvm::test
