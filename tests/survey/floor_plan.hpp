// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "survey/surface_sampler.hpp"

namespace nvm::test {

/// A partition of a floor plan that runs along x or y.
struct PlannedWall {
  bool along_x = true;
  double at = 0.0;  ///< y (or x) of its middle [m]
  double from = 0.0;
  double to = 0.0;
  double thickness = 0.1;
  double door = -1.0;  ///< where a door of 0.9 m begins; -1: none
};

/// Rooms that halve each other at random until they are small, as a map sees them from inside:
/// partitions of 3 to 15 cm with doors, outer walls, floor and ceiling.
class FloorPlan {
 public:
  static constexpr double kHeight = 2.6;
  static constexpr double kDoorWidth = 0.9;
  static constexpr double kDoorHeight = 2.0;

  explicit FloorPlan(std::mt19937_64& random) : random_(random) {
    const double width = uniform(7.0, 14.0);
    const double depth = uniform(6.0, 10.0);
    size_ = {width, depth};
    split({0.0, 0.0}, {width, depth});
  }

  const std::vector<PlannedWall>& walls() const { return walls_; }

  io::MapCloud map(double noise) {
    SurfaceSampler sampler(random_);
    sampler.noise = noise;
    for (const PlannedWall& wall : walls_) {
      add(wall, sampler);
    }
    const Eigen::Vector3d x(size_.x(), 0, 0);
    const Eigen::Vector3d y(0, size_.y(), 0);
    const Eigen::Vector3d z(0, 0, kHeight);
    sampler.add({0, 0, 0}, x, y);
    sampler.add(z, y, x);
    sampler.add({0, 0, 0}, z, x);
    sampler.add(y, x, z);
    sampler.add({0, 0, 0}, y, z);
    sampler.add(x, z, y);
    return sampler.cloud;
  }

 private:
  double uniform(double min, double max) {
    return std::uniform_real_distribution<double>(min, max)(random_);
  }

  void split(const Eigen::Vector2d& min, const Eigen::Vector2d& max) {
    constexpr double kSmallest = 2.2;  // [m]
    const Eigen::Vector2d size = max - min;
    const bool along_x = size.y() > size.x();
    const double extent = along_x ? size.y() : size.x();
    if (extent < 2.0 * kSmallest + 0.2) {
      return;
    }
    PlannedWall wall;
    wall.along_x = along_x;
    wall.thickness = uniform(0.03, 0.15);
    const double low = along_x ? min.y() : min.x();
    do {
      wall.at = uniform(low + kSmallest, low + extent - kSmallest);
    } while (continues_another(wall));
    wall.from = along_x ? min.x() : min.y();
    wall.to = along_x ? max.x() : max.y();
    if (uniform(0.0, 1.0) < 0.7) {
      wall.door = uniform(wall.from + 0.3, wall.to - kDoorWidth - 0.3);
    }
    walls_.push_back(wall);
    const double half = 0.5 * wall.thickness;
    split(
        min,
        along_x ? Eigen::Vector2d(max.x(), wall.at - half)
                : Eigen::Vector2d(wall.at - half, max.y()));
    split(
        along_x ? Eigen::Vector2d(min.x(), wall.at + half)
                : Eigen::Vector2d(wall.at + half, min.y()),
        max);
  }

  /// True when a face of `wall` is within 2 cm of one of another wall in the same direction: nobody
  /// could say whether that is one wall or two.
  bool continues_another(const PlannedWall& wall) const {
    return std::any_of(walls_.begin(), walls_.end(), [&](const PlannedWall& other) {
      const double apart = std::abs(wall.at - other.at);
      return other.along_x == wall.along_x &&
             std::abs(apart - 0.5 * std::abs(wall.thickness - other.thickness)) < 0.02;
    });
  }

  /// The spans of a face of `wall` that nothing abuts on: side +1 or -1.
  std::vector<std::array<double, 2>> free_spans(const PlannedWall& wall, double side) const {
    std::vector<std::array<double, 2>> cuts;
    for (const PlannedWall& other : walls_) {
      const double end = side > 0 ? other.from : other.to;
      if (other.along_x != wall.along_x &&
          std::abs(end - wall.at - 0.5 * side * wall.thickness) < 1e-6 && other.at > wall.from &&
          other.at < wall.to) {
        cuts.push_back({other.at - 0.5 * other.thickness, other.at + 0.5 * other.thickness});
      }
    }
    cuts.push_back({wall.to, wall.to});
    std::sort(cuts.begin(), cuts.end());
    std::vector<std::array<double, 2>> spans;
    double begin = wall.from;
    for (const auto& cut : cuts) {
      spans.push_back({begin, cut[0]});
      begin = cut[1];
    }
    return spans;
  }

  void add(const PlannedWall& wall, SurfaceSampler& sampler) const {
    for (const double side : {-1.0, 1.0}) {
      for (const auto& span : free_spans(wall, side)) {
        add_strip(wall, side, span[0], span[1], sampler);
      }
    }
  }

  /// A strip of one face, without its door.
  static void add_strip(
      const PlannedWall& wall, double side, double from, double to, SurfaceSampler& sampler) {
    if (wall.door >= 0.0 && wall.door < to && wall.door + kDoorWidth > from) {
      const double door_to = wall.door + kDoorWidth;
      add_rectangle(wall, side, {from, std::max(from, wall.door)}, 0.0, sampler);
      add_rectangle(
          wall, side, {std::max(from, wall.door), std::min(to, door_to)}, kDoorHeight, sampler);
      add_rectangle(wall, side, {std::min(to, door_to), to}, 0.0, sampler);
    } else {
      add_rectangle(wall, side, {from, to}, 0.0, sampler);
    }
  }

  static void add_rectangle(
      const PlannedWall& wall,
      double side,
      const std::array<double, 2>& span,
      double bottom,
      SurfaceSampler& sampler) {
    if (span[1] - span[0] < 0.02) {
      return;
    }
    const double across = wall.at + 0.5 * side * wall.thickness;
    const Eigen::Vector3d corner = wall.along_x ? Eigen::Vector3d(span[0], across, bottom)
                                                : Eigen::Vector3d(across, span[0], bottom);
    const Eigen::Vector3d along =
        (span[1] - span[0]) * (wall.along_x ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY());
    const Eigen::Vector3d up(0.0, 0.0, kHeight - bottom);
    // along x up looks to -y along x, and to +x along y.
    if ((side < 0) == wall.along_x) {
      sampler.add(corner, along, up);
    } else {
      sampler.add(corner + along, -along, up);
    }
  }

  std::mt19937_64& random_;
  Eigen::Vector2d size_;
  std::vector<PlannedWall> walls_;
};

}  // namespace nvm::test
