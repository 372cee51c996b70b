// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "nvm/geometry/pose.hpp"

namespace nvm::test {

/// Points of one scan with the unit normals of their surfaces, which look back at the sensor; scan
/// frame.
struct RoomScan {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
};

/// A room of 8 x 6 x 3 m around the origin with a cupboard and a 10 cm thick partition in it: no
/// two poses see the same.
class Room {
 public:
  /// What a sensor at `T_map_scan` inside the room sees in `count` random directions, with ranges
  /// that err by `noise` [m].
  RoomScan scan(
      const Pose& T_map_scan, std::size_t count, double noise, std::mt19937_64& rng) const {
    std::normal_distribution<double> normal;
    RoomScan result;
    const Eigen::Matrix3d R_scan_map = T_map_scan.linear().transpose();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d direction =
          Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized();
      const Hit hit = cast(T_map_scan.translation(), direction);
      const Eigen::Vector3d p_scan = R_scan_map * direction * (hit.range + noise * normal(rng));
      result.points.push_back(p_scan.cast<float>());
      result.normals.push_back((R_scan_map * hit.normal).cast<float>());
    }
    return result;
  }

 private:
  struct Box {
    Eigen::Vector3d min;
    Eigen::Vector3d max;
  };

  struct Hit {
    double range;
    Eigen::Vector3d normal;
  };

  // The nearest crossing of a face of any box, seen from outside of the furniture and inside of the
  // walls.
  Hit cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    Hit best{std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero()};
    for (const Box& box : boxes_) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double face : {box.min[axis], box.max[axis]}) {
          const double range = (face - origin[axis]) / direction[axis];
          if (range > 1e-9 && range < best.range &&
              on_face(box, axis, origin + range * direction)) {
            best.range = range;
            best.normal = -std::copysign(1.0, direction[axis]) * Eigen::Vector3d::Unit(axis);
          }
        }
      }
    }
    return best;
  }

  static bool on_face(const Box& box, int axis, const Eigen::Vector3d& point) {
    for (int other = 0; other < 3; ++other) {
      if (other != axis && (point[other] < box.min[other] || point[other] > box.max[other])) {
        return false;
      }
    }
    return true;
  }

  std::vector<Box> boxes_{
      {{-4.0, -3.0, -1.5}, {4.0, 3.0, 1.5}},   // walls, floor and ceiling
      {{2.5, -3.0, -1.5}, {4.0, -1.8, 0.7}},   // cupboard
      {{-1.5, 0.9, -1.5}, {-1.4, 3.0, 1.5}}};  // partition
};

}  // namespace nvm::test
