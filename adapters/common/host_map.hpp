// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "adapters/common/host_options.hpp"
#include "adapters/common/normal_finder.hpp"
#include "adapters/common/point_fields.hpp"
#include "adapters/common/surfaces.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/map/voxel_map.hpp"

namespace nvm::adapters {

/// The part that all adapters share: a VoxelMap that takes a host's own points, finds their normals
/// by a NormalPolicy, and needs no configuration to be constructed.
///
/// Costs nothing until the first insertion, so hosts may keep it in a global variable. Const
/// members may run from many threads at once, every other member needs the map for itself.
class HostMap {
 public:
  HostMap() = default;
  explicit HostMap(const HostOptions& options) { configure(options); }

  /// What the map has been, or will be, made with.
  const HostOptions& options() const noexcept { return options_; }
  /// Drops the map; the next insertion makes one with these options. Throws std::invalid_argument
  /// when they are out of range.
  void configure(const HostOptions& options) {
    options.validate();
    options_ = options;
    normals_.set_policy(options.normals);
    map_.reset();
    noise_ = {};
  }
  /// Where the sensor is [m], map frame, from now on. Not finite, as at the start: unknown.
  void set_view_point(const Eigen::Vector3d& p_map_sensor) noexcept {
    normals_.set_view_point(p_map_sensor);
  }
  /// The normals that points are inserted with and that queries go by.
  const NormalFinder& normals() const noexcept { return normals_; }

  /// Inserts points that are in the map frame. Throws std::invalid_argument when the options are
  /// out of range, std::bad_alloc when there is no memory for them.
  template <class Points>
  InsertStats insert(const Points& points) {
    return insert(points, normals_.insert_normals(points));
  }

  /// The same with normals of their own, a range as long as `points`. Sightings become the normals
  /// of surfaces that the map knows, or stay; what is neither goes in without a normal. Policy
  /// `missing` may say to drop both.
  template <class Points, class Normals>
  InsertStats insert(const Points& points, const Normals& normals) {
    VoxelMap& map = make_map();
    if (options_.normals.insert == NormalSource::kNone) {
      return evict(map.insert_unsided(points, T_grid_map()));
    }
    const std::vector<Eigen::Vector3f> known = settle(points, normals);
    InsertStats stats = map.insert(points, known, T_grid_map());
    if (stats.no_normal > 0 && options_.normals.missing != MissingNormal::kDrop) {
      insert_missing(points, known, stats);
    }
    return evict(stats);
  }

  /// The neighbours of a host's point, by NormalPolicy::query. Otherwise as VoxelMap::nearest, with
  /// HostOptions::reach.
  template <class Point>
  std::size_t nearest(
      const Point& point, const NearestSearch& search, Neighbor* out) const noexcept {
    return nearest(nvm::position(point), normals_.query_normal(point), search, out);
  }

  /// The same with a `normal` in the map frame, or a sighting, which finds a surface or nothing.
  /// What is neither stands for none, and sees both sides unless policy `missing` says to drop.
  std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out) const noexcept {
    const bool gated = normals_.takes(normal) || is_unit_normal(normal);
    if (!map_ || (!gated && refuses_queries_without_normal())) {
      return 0;
    }
    const std::size_t count =
        gated ? nearest_on_surface(to_grid(point), normal, search, out)
              : map_->nearest(to_grid(point), reaching(search), out, query_context());
    if (options_.grid_offset != 0.0) {
      std::for_each(out, out + count, [this](Neighbor& n) { n.position = from_grid(n.position); });
    }
    return count;
  }

  /// Neighbours that deviate more from their plane [m], one standard deviation, are no surface.
  double max_surface_deviation() const noexcept { return noise_.max_deviation(); }

  /// The map, in its grid's frame (shifted by grid_offset), or null before the first insertion.
  VoxelMap* map() noexcept { return map_.get(); }
  const VoxelMap* map() const noexcept { return map_.get(); }
  Eigen::Vector3d from_grid(const Eigen::Vector3d& p_grid) const noexcept {
    return p_grid.array() - options_.grid_offset;
  }
  Eigen::Vector3d to_grid(const Eigen::Vector3d& p_map) const noexcept {
    return p_map.array() + options_.grid_offset;
  }

  std::size_t size() const noexcept { return map_ ? map_->size() : 0; }
  std::size_t voxel_count() const noexcept { return map_ ? map_->voxel_count() : 0; }
  void clear() noexcept {
    if (map_) {
      map_->clear();
    }
  }

  /// Calls visit(position [m, map frame], normal) for every stored point.
  template <class Visitor>
  void for_each_point(Visitor&& visit) const {
    if (map_) {
      map_->for_each_point(
          [&](const MapPoint& point) { visit(from_grid(point.position), point.normal); });
    }
  }

 private:
  bool refuses_queries_without_normal() const noexcept {
    return options_.normals.missing == MissingNormal::kDrop &&
           options_.normals.query != NormalSource::kNone;
  }

  static VoxelMap::QueryContext& query_context() noexcept {
    thread_local VoxelMap::QueryContext context;
    return context;
  }

  NearestSearch reaching(NearestSearch search) const noexcept {
    constexpr double kEverywhere = 1 << 22;  // rings
    const double rings = std::ceil(options_.reach / options_.map.voxel_size);
    search.rings = std::max(search.rings, static_cast<int>(std::min(rings, kEverywhere)));
    return search;
  }

  std::size_t nearest_on_surface(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out) const noexcept {
    if (options_.surface_neighbors == 0) {
      const std::size_t count =
          map_->nearest(point, normal, reaching(search), out, query_context());
      return !is_sighting(normal) || surface_of(out, count, normal, max_surface_deviation()) ? count
                                                                                             : 0;
    }
    std::array<Neighbor, kMaxNeighbors> found;
    NearestSearch wider = search;
    wider.count = std::min(std::max(search.count, options_.surface_neighbors), kMaxNeighbors);
    const std::size_t all =
        map_->nearest(point, normal, reaching(wider), found.data(), query_context());
    const std::optional<Plane> plane =
        surface_of(found.data(), all, normal, max_surface_deviation());
    if (!plane) {
      return 0;
    }
    const std::size_t count = std::min(search.count, all);
    std::transform(found.data(), found.data() + count, out, [&plane](Neighbor neighbor) {
      neighbor.position -= plane->normal.dot(neighbor.position - plane->centroid) * plane->normal;
      return neighbor;
    });
    return count;
  }

  VoxelMap& make_map() {
    if (!map_) {
      map_.reset(
          new VoxelMap(options_.map));  // ct-lio has a std::make_unique of its own: ambiguous
    }
    return *map_;
  }

  Pose T_grid_map() const {
    Pose T = Pose::Identity();
    T.translation().setConstant(options_.grid_offset);
    return T;
  }

  template <class Points, class Normals>
  std::vector<Eigen::Vector3f> settle(const Points& points, const Normals& normals) {
    std::vector<Eigen::Vector3f> known(normals.size());
    VoxelMap::QueryContext context;
    for (std::size_t i = 0; i < std::min<std::size_t>(points.size(), known.size()); ++i) {
      known[i] = nvm::position(normals[i]).template cast<float>();
      if (normals_.takes(known[i])) {
        known[i] = settled_normal(*map_, to_grid(nvm::position(points[i])), known[i], context);
      } else if (!is_unit_normal(known[i])) {
        known[i].setZero();
      } else if (options_.surface_neighbors > 0 && i % kEveryLearned == 0) {
        learn_noise(to_grid(nvm::position(points[i])), known[i], context);
      }
    }
    return known;
  }

  void learn_noise(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      VoxelMap::QueryContext& context) {
    std::array<Neighbor, kMaxNeighbors> found;
    const NearestSearch search{options_.surface_neighbors, kFar, Gate::kSurfaces};
    noise_.show(found.data(), map_->nearest(point, normal, search, found.data(), context));
  }

  template <class Points>
  void insert_missing(
      const Points& points, const std::vector<Eigen::Vector3f>& normals, InsertStats& stats) {
    std::vector<Eigen::Vector3d> missing;
    missing.reserve(stats.no_normal);
    for (std::size_t i = 0; i < static_cast<std::size_t>(points.size()); ++i) {
      if (normals[i].isZero()) {
        missing.push_back(nvm::position(points[i]));
      }
    }
    const InsertStats added = map_->insert_unsided(missing, T_grid_map());
    stats.no_normal = 0;
    stats.stored += added.stored;
    stats.too_close += added.too_close;
    stats.surface_full += added.surface_full;
    stats.map_full += added.map_full;
    stats.new_voxels += added.new_voxels;
    stats.evicted_voxels += added.evicted_voxels;
    stats.evicted_points += added.evicted_points;
  }

  InsertStats evict(InsertStats stats) {
    if (options_.map.eviction == Eviction::kRadius && normals_.view_point().allFinite()) {
      map_->keep_within(to_grid(normals_.view_point()), options_.map.eviction_radius, stats);
    }
    return stats;
  }

  static constexpr double kFar = 1e6;              // [m]; beyond the 27 voxels
  static constexpr std::size_t kEveryLearned = 8;  // of the inserted points: enough, and cheap

  HostOptions options_;
  NormalFinder normals_;
  SurfaceNoise noise_;
  std::unique_ptr<VoxelMap> map_;
};

}  // namespace nvm::adapters
