// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "adapters/common/host_map.hpp"

namespace nvm::adapters {

/// An nvm map for ct-lio and the released II-NVM, in place of their `voxelHashMap` and of the
/// bodies that search it, fill it and evict from it. docs/adapters/ct_lio.md says what to change.
///
/// Defaults: normals or sightings are given; points with neither are stored without a side, and
/// queries with neither see both sides: to drop them, as the paper has it, takes the floor, and
/// with it the height, from a sensor with 16 beams. With set_view_point() and the functions without
/// normals, it tells sides by the direction to the sensor.
///
/// search() may run from many threads at once, every other member needs the map for itself.
class CtLioMap {
 public:
  using Points = std::vector<Eigen::Vector3d, Eigen::aligned_allocator<Eigen::Vector3d>>;

  /// Costs nothing before the first add().
  CtLioMap() = default;
  /// Throws std::invalid_argument when the options are out of range.
  explicit CtLioMap(const HostOptions& options) { map_.configure(options); }

  static HostOptions defaults() { return {}; }
  /// The host's own map, for comparisons; lengths [m] as the host's options have them. The host
  /// truncates indices toward zero, which makes the voxels at the axes planes twice as wide; here
  /// all are alike.
  static HostOptions transparent(
      double voxel_size, double min_distance, int max_num_points_in_voxel) {
    HostOptions options = transparent_options(voxel_size);
    options.map.min_point_distance = min_distance;
    options.map.points_per_surface = max_num_points_in_voxel;
    return options;
  }

  /// Empties the map and changes its options; throws as the constructor.
  void configure(const HostOptions& options) { map_.configure(options); }
  const HostMap& map() const noexcept { return map_; }
  /// Where the sensor is, map frame [m]: before add() and search(), for view directions.
  void set_view_point(const Eigen::Vector3d& p_map_sensor) { map_.set_view_point(p_map_sensor); }
  /// One line when the voxels are too small for points `spacing` [m] apart; else empty.
  std::string density_warning(double spacing) const {
    return adapters::density_warning(map_.options().map.voxel_size, spacing, 20);
  }

  /// The up to `count` (at most 64) nearest points, nearest first, that agree with `normal`, all in
  /// the map frame. `ring` 1 looks into 27 voxels, 2 into 125 as the hosts do in their first
  /// frames. A `normal` that is neither a unit vector nor a sighting stands for none.
  Points search(
      const Eigen::Vector3d& point, const Eigen::Vector3d& normal, int count, int ring = 1) const {
    std::array<Neighbor, kMaxNeighbors> found;
    const auto wanted = static_cast<std::size_t>(std::clamp<int>(count, 0, kMaxNeighbors));
    const Eigen::Vector3f gate = normal.cast<float>();
    const NearestSearch search{wanted, kAnyDistance, Gate::kSurfaces, ring};
    const std::size_t size = map_.nearest(point, gate, search, found.data());
    Points points(size);
    std::transform(found.begin(), found.begin() + size, points.begin(), [](const Neighbor& n) {
      return n.position;
    });
    return points;
  }
  /// The same along the direction to the view point.
  Points search(const Eigen::Vector3d& point, int count, int ring = 1) const {
    return search(point, map_.normals().query_normal(point).cast<double>(), count, ring);
  }

  /// Adds all points of a scan at once; points and normals are ranges of equal length, map frame.
  template <class Range, class Normals>
  InsertStats add(const Range& points, const Normals& normals) {
    return map_.insert(points, normals);
  }
  /// The same with the directions to the view point.
  template <class Range>
  InsertStats add(const Range& points) {
    return map_.insert(points);
  }

  /// Drops the voxels whose centre is farther than `radius` [m] from `center`; returns the number
  /// of points. The map bounds itself: with least-recently-used eviction this need not be called.
  std::size_t evict_beyond(const Eigen::Vector3d& center, double radius) {
    return map_.map() == nullptr ? 0 : map_.map()->erase_voxels_beyond(center, radius);
  }

  std::size_t size() const noexcept { return map_.size(); }

 private:
  static constexpr double kAnyDistance = 1e6;

  HostMap map_;
};

}  // namespace nvm::adapters
