// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>

#include "nvm/core/option.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"
#include "nvm/map/point_values.hpp"

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
  kRadius,  ///< whoever knows where the sensor is also calls VoxelMap::keep_within() after each
            ///< scan, with eviction_radius: insertion itself never drops what is far
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
  /// Moved points may come nearer to each other than min_point_distance. What an erasure leaves of
  /// a surface counts anew.
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
  /// What points carry beside position and normal; none of it decides anything.
  MapColumns columns;

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  NVM_SHARED void validate() const;

  static constexpr std::size_t kMaxCapacity = std::size_t{1} << 26;
  static constexpr std::size_t kMinBytes = std::size_t{1} << 20;
  static constexpr int kMaxPointsPerSurface = 120;
};

inline namespace NVM_TARGET {

/// Walks over the options (nvm/core/option.hpp); `Options` is MapOptions, const or not.
template <class Options, class Visitor>
void visit_options(Options& options, Visitor&& visit) {
  constexpr double kPi = 3.141592653589793;
  constexpr double kMostBytes = 9.2e18;
  using Rules = OptionChoices<SurfaceRule, 2>;
  using Evictions = OptionChoices<Eviction, 2>;
  visit({"voxel_size", 0.01, 100.0, "m", "Edge of a voxel"}, options.voxel_size);
  visit(
      {"capacity", 1.0, MapOptions::kMaxCapacity, "voxels", "What it holds at most"},
      options.capacity);
  visit(
      {"max_bytes", 0.0, kMostBytes, "bytes", "Memory at most; 0: what capacity needs"},
      options.max_bytes);
  visit(
      {"points_per_surface", 1.0, MapOptions::kMaxPointsPerSurface, "", "Points at most"},
      options.points_per_surface);
  visit(
      {"min_point_distance", 0.0, 200.0, "m", "Between stored points"}, options.min_point_distance);
  visit(
      {"space_across_voxels", 0.0, 1.0, "", "Also between those of two voxels"},
      options.space_across_voxels);
  visit(
      {"max_merged_points",
       1.0,
       255.0,
       "",
       "Points that a stored one becomes the mean plane of, at most; 1: it never moves"},
      options.max_merged_points);
  visit({"max_surfaces", 1.0, 8.0, "", "Surfaces of a voxel"}, options.max_surfaces);
  visit(
      {"surface_rule", 0.0, 1.0, "", "Which surface takes a point"},
      options.surface_rule,
      Rules{{{"paper", SurfaceRule::kPaper}, {"smallest_angle", SurfaceRule::kSmallestAngle}}});
  visit(
      {"max_surface_angle", 0.0, kPi, "rad", "Of a point to its surface"},
      options.max_surface_angle);
  visit(
      {"max_point_angle", 0.0, kPi, "rad", "Of a neighbour to the query"}, options.max_point_angle);
  visit(
      {"eviction", 0.0, 1.0, "", "What leaves the map"},
      options.eviction,
      Evictions{{{"lru", Eviction::kLeastRecentlyUsed}, {"radius", Eviction::kRadius}}});
  visit({"eviction_radius", 0.01, 1e9, "m", "With eviction: radius"}, options.eviction_radius);
  visit_columns([&](const OptionInfo& info, auto kept, auto /*value*/) {
    visit(info, options.columns.*kept);
  });
}

}  // namespace NVM_TARGET

inline void MapOptions::validate() const {
  visit_options(*this, detail::OptionValidator());
  require(
      max_bytes == 0 || max_bytes >= kMinBytes,
      "max_bytes",
      max_bytes,
      "0 (no limit) or at least 1 MiB");
  require(
      min_point_distance <= 2.0 * voxel_size,
      "min_point_distance",
      min_point_distance,
      "from 0 to twice the voxel size");
  require(
      eviction_radius >= voxel_size, "eviction_radius", eviction_radius, "at least the voxel size");
}

}  // namespace nvm
