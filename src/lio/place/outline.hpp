// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "lio/place/wall_grid.hpp"

namespace nvm::lio {

/// What of a map or a scan tells where it is once it is level: its walls, and how high its floors
/// and ceilings lie.
class Outline {
 public:
  struct Upright {
    WallPoint wall;
    double height = 0.0;  ///< [m]
  };

  /// Takes a point [m] with its unit normal; z is up. At most one wall point that faces one way in
  /// each cube of WallGrid::kCell.
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

  const std::vector<Upright>& walls() const { return walls_; }

  /// How much higher the origin of `scan` lies than that of this one [m], most likely first, as
  /// floors and ceilings tell; at most `count`.
  std::vector<double> heights_of(const Outline& scan, std::size_t count) const;

  /// The walls at the heights at which `scan`, lifted by `height` [m], has some.
  WallGrid grid_for(const Outline& scan, double height) const;

 private:
  std::vector<Upright> walls_;
  std::vector<double> floors_, ceilings_;  ///< of the points of each [m]
  std::unordered_set<std::uint64_t> cells_;
};

}  // namespace nvm::lio
