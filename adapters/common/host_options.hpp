// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>

#include "nvm/core/finite.hpp"
#include "nvm/core/require.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/neighbor.hpp"

namespace nvm::adapters {

/// Where an adapter takes the normal of a host's point from.
enum class NormalSource {
  kNone,           ///< nowhere: points have no sides and queries see both
  kViewDirection,  ///< the direction to the sensor, which needs a view point
  kPoint,          ///< the point's own normal fields
};

/// What becomes of a point whose normal source does not give a unit vector.
enum class MissingNormal {
  kDrop,           ///< it is not inserted, and as a query finds nothing (the paper)
  kUngated,        ///< as with NormalSource::kNone
  kViewDirection,  ///< its sighting (nvm/map/sighting.hpp), else the direction to the sensor;
                   ///< without a view point as kUngated
};

/// How an adapter uses normals.
struct NormalPolicy {
  NormalSource insert = NormalSource::kPoint;
  NormalSource query = NormalSource::kPoint;
  MissingNormal missing = MissingNormal::kViewDirection;
};

/// Configuration of the map behind an adapter.
struct HostOptions {
  /// Eviction::kRadius is measured from the view point.
  MapOptions map;
  NormalPolicy normals;
  /// Queries that find too few neighbours in the 27 voxels around them look on, in all voxels that
  /// are no farther away than this [m] (NearestSearch::rings); 0: they do not.
  double reach = 0.0;
  /// For hosts that fit planes to few neighbours: queries with a normal look at so many, return
  /// those that were asked for moved onto the plane of all, and nothing when these are no surface
  /// (3 to kMaxNeighbors); 0: queries return points as they are.
  std::size_t surface_neighbors = 0;
  /// Moves the grid of voxels against the map frame [m]: half a voxel for hosts that round where
  /// nvm takes the floor.
  double grid_offset = 0.0;

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  void validate() const {
    map.validate();
    visit_columns([this](const OptionInfo& info, auto kept, auto /*value*/) {
      require(!(map.columns.*kept), info.name, true, "false: an adapter hands no values over");
    });
    require(reach >= 0.0, "reach", reach, "0 or more [m]");
    require(
        surface_neighbors == 0 || (surface_neighbors >= 3 && surface_neighbors <= kMaxNeighbors),
        "surface_neighbors",
        surface_neighbors,
        "0 or 3 to 64");
    require(nvm::detail::is_finite(grid_offset), "grid_offset", grid_offset, "finite [m]");
  }
};

/// HostOptions::surface_neighbors for hosts that ask for 5: 20 cost more and give no more, and with
/// 5 a surface is hard to tell from an edge (docs/adapters/ikd_tree.md).
inline constexpr std::size_t kSurfaceNeighbors = 12;

/// A map without sides that keeps what it is given, as hosts' own maps do: for comparisons that
/// isolate what normals change. Surfaces hold the most points that nvm allows, 120.
inline HostOptions transparent_options(double voxel_size) {
  HostOptions options;
  options.map.voxel_size = voxel_size;
  options.map.max_surfaces = 1;
  options.map.points_per_surface = MapOptions::kMaxPointsPerSurface;
  options.map.min_point_distance = 0.0;
  options.normals = {NormalSource::kNone, NormalSource::kNone, MissingNormal::kUngated};
  return options;
}

/// The smallest voxel [m] in which a host that keeps one point per `spacing` [m] finds `neighbors`
/// neighbours on a wall. The 27 voxels around a query hold 9 (d / spacing)^2 points of a wall;
/// measured, 5 neighbours need d = spacing and 20 need d = 2 spacing, which is 1.8 times as many.
inline double smallest_voxel(double spacing, int neighbors) {
  return spacing * std::sqrt(0.2 * neighbors);
}

/// One line for the host's log when voxels are too small for the host's `spacing`; else empty. Such
/// a map answers with too few neighbours, which hosts report as "no effective points".
inline std::string density_warning(double voxel_size, double spacing, int neighbors) {
  const double smallest = smallest_voxel(spacing, neighbors);
  if (voxel_size >= smallest * (1.0 - 1e-6)) {
    return {};
  }
  std::ostringstream text;
  text << "nvm: voxel_size = " << voxel_size << " m is too small for points " << spacing
       << " m apart: " << neighbors << " neighbours need at least " << smallest << " m";
  return text.str();
}

}  // namespace nvm::adapters
