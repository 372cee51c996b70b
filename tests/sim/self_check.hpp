// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cmath>
#include <cstddef>

#include "common/sensor_data.hpp"
#include "sim/motion.hpp"
#include "sim/ray_caster.hpp"

namespace nvm::test {

/// How far the points of scans are from where the truth says they should be.
class RangeResiduals {
 public:
  /// Casts a ray along each point of `scan` from the true pose at its time, `clock_shift` [s]
  /// later.
  void add(
      const Scan& scan,
      const sim::RayCaster& rays,
      const sim::Motion& motion,
      const Pose& T_imu_lidar,
      double clock_shift = 0.0) {
    constexpr double kFarOff = 0.1;  // ten sigma: another surface
    for (const TimedPoint& point : scan.points) {
      const double time = scan.t_begin + static_cast<double>(point.dt) + clock_shift;
      const Pose T_world_lidar = motion.pose(time) * T_imu_lidar;
      const Eigen::Vector3d p = Eigen::Vector3f(point.x, point.y, point.z).cast<double>();
      const auto hit =
          rays.cast(T_world_lidar.translation(), T_world_lidar.linear() * p.normalized(), 1000.0);
      const double residual = hit ? p.norm() - hit->range : kFarOff;
      if (std::abs(residual) < kFarOff) {
        sum_ += residual;
        sq_sum_ += residual * residual;
        ++hits_;
      } else {
        ++misses_;
      }
    }
  }

  double mean() const { return sum_ / static_cast<double>(hits_); }
  double sigma() const { return std::sqrt(sq_sum_ / static_cast<double>(hits_) - mean() * mean()); }
  double misses() const { return static_cast<double>(misses_) / static_cast<double>(hits_); }

  /// True when the points lie on the surfaces of the scene within noise of `sigma` [m].
  bool is_consistent(double expected_sigma) const {
    return std::abs(mean()) < 1e-4 && std::abs(sigma() / expected_sigma - 1.0) < 0.01 &&
           misses() < 1e-3;
  }

 private:
  double sum_ = 0.0;
  double sq_sum_ = 0.0;
  std::size_t hits_ = 0;
  std::size_t misses_ = 0;
};

}  // namespace nvm::test
