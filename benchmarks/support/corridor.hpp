// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "nvm/geometry/pose.hpp"

namespace nvm::benchmarks {

/// A scan in its own frame, with true unit normals, and its pose.
struct CorridorScan {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  Pose T_map_scan = Pose::Identity();
};

/// An endless corridor along x, 3.1 m wide and 2.7 m high, with rooms on both sides behind 10 cm
/// walls with doors, seen by a spinning sensor of 16 rings that walks along it. The origin and all
/// sizes are odd, so that no wall lies on a voxel face by accident.
class Corridor {
 public:
  /// Scan `index` of a walk of 0.1 m steps; 16 rings of `columns` points, range noise 1 cm.
  static CorridorScan scan(int index, int columns = 1500) {
    std::mt19937_64 rng(static_cast<std::uint64_t>(index) + 1);
    std::normal_distribution<double> noise(0.0, 0.01);
    CorridorScan scan;
    const double x = 0.1 * index;
    scan.T_map_scan.translation() =
        Eigen::Vector3d(kOffset.x() + x, kOffset.y() + 0.6 * std::sin(0.3 * x), kOffset.z() + 0.1);
    scan.T_map_scan.linear() =
        so3_exp({0.02 * std::sin(x), 0.03 * std::cos(0.7 * x), 0.4 * std::sin(0.2 * x)});
    for (int column = 0; column < columns; ++column) {
      for (int ring = 0; ring < 16; ++ring) {
        const double azimuth = 2.0 * kPi * column / columns;
        const double elevation = (-15.0 + 2.0 * ring) * kPi / 180.0;
        const Eigen::Vector3d d_scan(
            std::cos(elevation) * std::cos(azimuth),
            std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation));
        const Hit hit =
            cast(scan.T_map_scan.translation() - kOffset, scan.T_map_scan.linear() * d_scan);
        if (hit.range < 40.0) {
          scan.points.push_back((d_scan * (hit.range + noise(rng))).cast<float>());
          scan.normals.push_back((scan.T_map_scan.linear().transpose() * hit.normal).cast<float>());
        }
      }
    }
    return scan;
  }

 private:
  static constexpr double kPi = 3.141592653589793;
  static constexpr double kHalfHeight = 1.35;
  static constexpr double kInner = 1.55;  // corridor's face of its walls
  static constexpr double kOuter = 1.65;  // the rooms' face
  static constexpr double kBack = 6.37;   // far wall of the rooms
  static constexpr double kRoom = 4.27;   // length of a room along x, and its 10 cm partition
  static inline const Eigen::Vector3d kOffset{101.37, -53.21, 7.43};

  struct Hit {
    double range = std::numeric_limits<double>::infinity();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  static bool is_door(double x) {
    const double place = x - kRoom * std::floor(x / kRoom);
    return place > 1.0 && place < 1.9;
  }

  static Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
    Hit best;
    const auto plane = [&](int axis, double at, auto&& exists) {
      const double range = (at - origin[axis]) / direction[axis];
      if (range > 1e-6 && range < best.range && exists(origin + range * direction)) {
        best.range = range;
        best.normal = Eigen::Vector3d::Unit(axis) * (direction[axis] > 0.0 ? -1.0 : 1.0);
      }
    };
    const auto everywhere = [](const Eigen::Vector3d&) { return true; };
    plane(2, kHalfHeight, everywhere);
    plane(2, -kHalfHeight, everywhere);
    for (const double side : {-1.0, 1.0}) {
      plane(1, side * kBack, everywhere);
      for (const double face : {kInner, kOuter}) {
        plane(1, side * face, [](const Eigen::Vector3d& p) { return !is_door(p.x()); });
      }
    }
    const int room = static_cast<int>(std::floor(origin.x() / kRoom));
    for (int wall = room - 4; wall <= room + 5; ++wall) {
      for (const double face : {-0.05, 0.05}) {
        plane(0, wall * kRoom + face, [](const Eigen::Vector3d& p) {
          return std::abs(p.y()) > kOuter;
        });
      }
    }
    return best;
  }
};

}  // namespace nvm::benchmarks
