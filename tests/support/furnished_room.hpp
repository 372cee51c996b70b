// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace nvm::test {

/// Points of one scan in the frame of the sensor, with the true unit normals of their surfaces,
/// which look back at the sensor.
struct TrueScan {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
};

/// Directions of the rays of one frame, sensor frame.
using Directions = std::vector<Eigen::Vector3d>;

inline Eigen::Vector3d direction(double azimuth, double elevation) {
  return {
      std::cos(elevation) * std::cos(azimuth),
      std::cos(elevation) * std::sin(azimuth),
      std::sin(elevation)};
}

/// A spinning sensor: `rings` rings from -15 to 15 degrees, fired together `firings` times per
/// turn. 16 rings of 1500 firings are a VLP-16 at 10 Hz, 24 k points.
inline Directions spinning_directions(int rings, int firings) {
  constexpr double kDegree = 0.017453292519943295;
  Directions directions;
  for (int firing = 0; firing < firings; ++firing) {
    for (int ring = 0; ring < rings; ++ring) {
      const double elevation = (-15.0 + 30.0 * ring / (rings - 1)) * kDegree;
      directions.push_back(direction(360.0 * kDegree * firing / firings, elevation));
    }
  }
  return directions;
}

/// A sensor like the Livox Mid-360: 360 by 59 degrees (-7 to 52) covered by curves that never
/// repeat; `frame` picks the frame. 20 000 rays are one frame at 10 Hz.
inline Directions non_repetitive_directions(std::size_t count, double frame) {
  constexpr double kTurn = 6.283185307179586;
  constexpr double kDegree = kTurn / 360.0;
  Directions directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = frame + static_cast<double>(i) / static_cast<double>(count);  // in frames
    const double azimuth = kTurn * 6.1803 * t + 0.1 * std::sin(kTurn * 83.0 * t);
    const double sweep = 0.5 + 0.5 * std::sin(kTurn * 137.5077 * t);
    directions.push_back(direction(azimuth, (-7.0 + 59.0 * sweep) * kDegree));
  }
  return directions;
}

/// A random room with furniture: walls, floor and ceiling, boxes that stand on the floor turned at
/// random, and thin panels. The sensor stands near the middle, a little tilted.
class FurnishedRoom {
 public:
  /// `size` is the length of the longer walls [m].
  FurnishedRoom(double size, std::mt19937_64& rng) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Eigen::Vector3d room(
        0.5 * size, 0.5 * size * (0.5 + 0.5 * unit(rng)), 1.2 + 0.4 * unit(rng));
    boxes_.push_back({Eigen::Vector3d(0.0, 0.0, room.z() - 1.0), room, 0.0});
    const auto pieces = static_cast<int>(6.0 + 8.0 * unit(rng));
    for (int piece = 0; piece < pieces; ++piece) {
      const bool is_panel = piece % 4 == 0;
      const Eigen::Vector3d half(
          0.2 + 0.8 * unit(rng), is_panel ? 0.025 : 0.2 + 0.4 * unit(rng), 0.2 + 0.9 * unit(rng));
      const double range = 1.5 + (room.y() - 1.5) * unit(rng);
      const double bearing = 6.283185307179586 * unit(rng);
      boxes_.push_back(
          {{range * std::cos(bearing), range * std::sin(bearing), half.z() - 1.0},
           half,
           3.14159265358979 * unit(rng)});
    }
    R_map_scan_ = Eigen::AngleAxisd(6.283185307179586 * unit(rng), Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(0.2 * unit(rng), Eigen::Vector3d::UnitX());
    origin_ = {0.3 * unit(rng), 0.3 * unit(rng), 0.3 * unit(rng)};
  }

  /// What the sensor sees, with ranges that err by `noise` [m] (one standard deviation).
  TrueScan scan(const Directions& directions, double noise, std::mt19937_64& rng) const {
    std::normal_distribution<double> error(0.0, noise);
    TrueScan result;
    for (const Eigen::Vector3d& direction_scan : directions) {
      const Hit hit = cast(R_map_scan_ * direction_scan);
      result.points.push_back((direction_scan * (hit.range + error(rng))).cast<float>());
      result.normals.push_back((R_map_scan_.transpose() * hit.normal).cast<float>());
    }
    return result;
  }

 private:
  struct Box {
    Eigen::Vector3d center;
    Eigen::Vector3d half_size;
    double yaw;
  };

  struct Hit {
    double range;
    Eigen::Vector3d normal;  // looks back at the sensor
  };

  Hit cast(const Eigen::Vector3d& ray) const {
    Hit best{std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero()};
    for (const Box& box : boxes_) {
      const Eigen::Matrix3d R_map_box =
          Eigen::AngleAxisd(box.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const Eigen::Vector3d from = R_map_box.transpose() * (origin_ - box.center);
      const Eigen::Vector3d along = R_map_box.transpose() * ray;
      for (int axis = 0; axis < 3; ++axis) {
        for (const double face : {-box.half_size[axis], box.half_size[axis]}) {
          const double range = (face - from[axis]) / along[axis];
          if (range > 1e-9 && range < best.range && on_face(box, axis, from + range * along)) {
            best.range = range;
            best.normal =
                R_map_box * (-std::copysign(1.0, along[axis]) * Eigen::Vector3d::Unit(axis));
          }
        }
      }
    }
    return best;
  }

  static bool on_face(const Box& box, int axis, const Eigen::Vector3d& point) {
    for (int other = 0; other < 3; ++other) {
      if (other != axis && std::abs(point[other]) > box.half_size[other]) {
        return false;
      }
    }
    return true;
  }

  std::vector<Box> boxes_;
  Eigen::Matrix3d R_map_scan_;
  Eigen::Vector3d origin_;
};

}  // namespace nvm::test
