// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>

#include "nvm/core/require.hpp"

namespace nvm {

/// Which surface of a voxel takes a point (spec §3.4).
enum class SurfaceRule {
  kPaper,          ///< the front when within max_surface_angle of it, else the back
  kSmallestAngle,  ///< the surface at the smallest angle; a new one when none is within
                   ///< max_surface_angle
};

/// What leaves the map to bound it (spec §3.5).
enum class Eviction {
  kLeastRecentlyUsed,  ///< only a full map evicts, and the voxel that has been unused for longest
                       ///< goes first
  kRadius,  ///< each insertion also drops the voxels farther than eviction_radius from the sensor
};

/// Configuration of a VoxelMap. Aggregate; the map's constructor validates it.
struct MapOptions {
  /// Edge of a voxel [m], 0.01 to 100; d of Eq. 4.
  double voxel_size = 0.3;
  /// The map never holds more voxels than this, 1 to 2^26.
  std::size_t capacity = 1'000'000;
  /// The map never owns more memory than this [bytes]; 0: as much as `capacity` voxels can need. At
  /// least 1 MiB.
  std::size_t max_bytes = 0;
  /// Points that one surface of a voxel holds, 1 to 120; N of spec §3.3.
  int points_per_surface = 20;
  /// Two points of one surface of a voxel are at least this far apart [m], 0 to 2 voxel_size.
  double min_point_distance = 0.1;
  /// Whether that also holds between neighbouring voxels, for points whose normals agree. Without
  /// it the few points that noise carries over a voxel's border are alone there, and stay: a wall
  /// grows thick where it runs along a border. Costs about 0.1 us per stored point.
  bool space_across_voxels = false;
  /// Points that a stored point stands for at most, 1 to 255. A point that is too close to be
  /// stored moves the one that it is too close to along the normal to the mean of their planes,
  /// until that one stands for this many; then it stays, so that the map does not follow a drifting
  /// trajectory. With 1 stored points never move. Needs normals, and 8 bytes more per 8 points.
  /// Moved points may come nearer to each other than min_point_distance. Insertion then takes one
  /// thread, whatever its executor. Not kept in map files; what an erasure leaves of a surface
  /// counts anew.
  int max_merged_points = 1;
  /// Surfaces in a voxel, 1 to 8: 2 for front and back, 1 for a map that does not tell sides apart.
  int max_surfaces = 2;
  SurfaceRule surface_rule = SurfaceRule::kPaper;
  /// A point joins, and a query reads, a surface whose principal direction is within this angle
  /// [rad], 0 to pi; theta of spec §3.4 and §3.6.
  double max_surface_angle = 1.5707963267948966;
  /// A query returns points whose own normal is within this angle [rad], 0 to pi; the point
  /// threshold of spec §3.6.
  double max_point_angle = 1.7453292519943295;
  Eviction eviction = Eviction::kLeastRecentlyUsed;
  /// With Eviction::kRadius: [m], at least voxel_size.
  double eviction_radius = 100.0;

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  void validate() const {
    constexpr double kPi = 3.141592653589793;
    require(
        voxel_size >= 0.01 && voxel_size <= 100.0, "voxel_size", voxel_size, "from 0.01 to 100 m");
    require(
        capacity >= 1 && capacity <= kMaxCapacity, "capacity", capacity, "from 1 to 2^26 voxels");
    require(
        max_bytes == 0 || max_bytes >= kMinBytes,
        "max_bytes",
        max_bytes,
        "0 (no limit) or at least 1 MiB");
    require(
        points_per_surface >= 1 && points_per_surface <= kMaxPointsPerSurface,
        "points_per_surface",
        points_per_surface,
        "from 1 to 120");
    require(
        min_point_distance >= 0.0 && min_point_distance <= 2.0 * voxel_size,
        "min_point_distance",
        min_point_distance,
        "from 0 to twice the voxel size");
    require(
        max_merged_points >= 1 && max_merged_points <= 255,
        "max_merged_points",
        max_merged_points,
        "from 1 to 255");
    require(max_surfaces >= 1 && max_surfaces <= 8, "max_surfaces", max_surfaces, "from 1 to 8");
    const auto require_angle = [](const char* name, double angle) {
      require(angle >= 0.0 && angle <= kPi, name, angle, "from 0 to pi rad");
    };
    require_angle("max_surface_angle", max_surface_angle);
    require_angle("max_point_angle", max_point_angle);
    require(
        eviction_radius >= voxel_size,
        "eviction_radius",
        eviction_radius,
        "at least the voxel size");
  }

  static constexpr std::size_t kMaxCapacity = std::size_t{1} << 26;
  static constexpr std::size_t kMinBytes = std::size_t{1} << 20;
  static constexpr int kMaxPointsPerSurface = 120;
};

}  // namespace nvm
