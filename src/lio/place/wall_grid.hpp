// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nvm::lio {

/// A point of an upright surface, and where it faces, seen from above.
struct WallPoint {
  Eigen::Vector2d position;  ///< [m]
  double facing = 0.0;       ///< azimuth of its normal [rad]
};

/// Where a scan may have been made, seen from above.
struct PlanarPlace {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of the scan's origin [m]
  double heading = 0.0;                                ///< the scan is turned by it [rad]
  std::size_t hits = 0;                                ///< points of the scan that meet a wall
};

/// The walls of a map seen from above, as cells that know in which directions they face, and for
/// each power of two up to 2^kLevels the union of so many cells in each direction: so that a bound
/// on how well a scan fits anywhere in a square is as cheap as how well it fits at one place.
class WallGrid {
 public:
  static constexpr double kCell = 0.3;  ///< [m]; a point meets walls in the cells around its own
  static constexpr std::size_t kMaxCells = 50'000'000;

  explicit WallGrid(const std::vector<WallPoint>& walls);

  /// Whether the map was too large, so that nothing is found.
  bool is_too_large() const { return is_too_large_; }

  /// The places in the map where most of `scan` (at most 255 points) meets walls that face it, best
  /// first: exhaustive over the map and all headings (branch and bound, best first). At most
  /// `count`, all of at least `min_hits`, and of those around one place only the best.
  std::vector<PlanarPlace> search(
      const std::vector<WallPoint>& scan, std::size_t count, std::size_t min_hits) const;

 private:
  static constexpr int kLevels = 5;
  static constexpr int kPadding = 1 << kLevels;

  /// A point of a scan at one heading.
  struct Ray {
    int x, y;            ///< cells from the origin
    std::uint8_t faces;  ///< a bit per direction, see faces_of()
  };
  struct Node;
  struct Frontier;

  void draw(const std::vector<WallPoint>& walls);
  void build_levels();
  std::vector<std::vector<Ray>> turned(const std::vector<WallPoint>& scan, double step) const;
  std::size_t hits(const std::vector<Ray>& rays, int level, int x, int y) const;

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();  ///< of cell (0, 0) [m]
  int width_ = 0;
  int height_ = 0;
  bool is_too_large_ = false;
  std::vector<std::vector<std::uint8_t>> levels_;  ///< padded below zero by kPadding cells
};

}  // namespace nvm::lio
