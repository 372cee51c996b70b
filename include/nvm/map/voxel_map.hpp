// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "nvm/core/point_access.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/insert_stats.hpp"
#include "nvm/map/map_concept.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/map_point.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/operations/erasure.hpp"
#include "nvm/map/operations/map_engine.hpp"
#include "nvm/map/operations/query_context.hpp"
#include "nvm/map/operations/traversal.hpp"
#include "nvm/map/point_values.hpp"
#include "nvm/map/storage/stored_normal.hpp"

namespace nvm {

inline namespace NVM_TARGET {
template <class Map>
class BasicMapArchive;
template <class Map>
class BasicMapImage;
}  // namespace NVM_TARGET

/// The NVM voxel map (paper III-B, spec §3): points with normals in voxels that keep a front and a
/// back surface, so that the two faces of a thin wall never meet, bounded by an exact LRU. Models
/// the map concept.
///
/// - Positions, up to +-2^20 voxels per axis, are stored to voxel_size / 8192 (37 um at 0.3 m),
///   normals to 0.4 degrees. Distances and angles are those of the stored values in exact integers:
///   the same input gives the same map and the same neighbours for any number of threads.
/// - Const members may run from many threads at once; the others need the map for themselves.
/// - Memory never exceeds memory_limit_bytes(); its pages are taken as the map fills.
/// - Queries mark the voxels that they answer from as used, which is what the LRU order goes by.
class VoxelMap {
 public:
  /// Scratch state of a thread's queries; see the map concept.
  using QueryContext = detail::VoxelQueryContext;

  /// Throws std::invalid_argument when `options` are out of range, std::bad_alloc when there is no
  /// memory for them.
  NVM_SHARED explicit VoxelMap(const MapOptions& options = {}) : engine_(options) {}

  /// A map that was moved from is empty, keeps its options, and takes memory again when it is used.
  NVM_SHARED VoxelMap(VoxelMap&& other) noexcept : engine_(std::move(other.engine_)) {}
  NVM_SHARED VoxelMap& operator=(VoxelMap&& other) noexcept {
    engine_ = std::move(other.engine_);
    return *this;
  }
  // NOLINTNEXTLINE(modernize-use-equals-default): an implicit one would not be always_inline
  NVM_SHARED ~VoxelMap() {}

  NVM_SHARED const MapOptions& options() const noexcept { return engine_.options(); }

  // --- insertion

  /// Inserts `points` with their `normals` (ranges of equal length, in the frame scan) at
  /// T_map_scan (Eq. 3): p_map = T p, n_map = R n. Normals have unit length and look at the sensor;
  /// a point whose plane is not known has a sighting instead (sighting.hpp).
  /// Points that cannot be stored are counted, never an error. Throws std::invalid_argument when
  /// the lengths differ or T_map_scan is not rigid. 15 to 60 ns per point.
  template <class Points, class Normals>
  NVM_SHARED InsertStats
  insert(const Points& points, const Normals& normals, const Pose& T_map_scan = Pose::Identity()) {
    static_assert(
        is_point_range_v<Points>, "nvm: points must be a range of points: size(), [] and x, y, z");
    static_assert(
        is_point_range_v<Normals>, "nvm: normals must be a range of 3-vectors as long as points");
    return engine_.insert(points, normals, T_map_scan, detail::NoValues());
  }

  /// The same with what the points carry beside, of which the map keeps its columns: `values` is a
  /// range of PointValues, as long as points. A point that is moved to a mean plane keeps those
  /// that it came with.
  template <class Points, class Normals, class Values>
  NVM_SHARED InsertStats insert(
      const Points& points, const Normals& normals, const Pose& T_map_scan, const Values& values) {
    static_assert(
        is_point_range_v<Points>, "nvm: points must be a range of points: size(), [] and x, y, z");
    static_assert(
        is_point_range_v<Normals>, "nvm: normals must be a range of 3-vectors as long as points");
    require(points.size() == values.size(), "values.size()", values.size(), "points.size()");
    return engine_.insert(points, normals, T_map_scan, values);
  }

  /// Inserts points without normals: all go to the front surface of their voxel, and only ungated
  /// queries find them. The baseline that cannot tell sides apart. Throws std::invalid_argument
  /// when T_map_scan is not rigid.
  template <class Points>
  NVM_SHARED InsertStats
  insert_unsided(const Points& points, const Pose& T_map_scan = Pose::Identity()) {
    static_assert(
        is_point_range_v<Points>, "nvm: points must be a range of points: size(), [] and x, y, z");
    return engine_.insert_unsided(points, T_map_scan, detail::NoValues());
  }
  /// The same with values, as above.
  template <class Points, class Values>
  NVM_SHARED InsertStats
  insert_unsided(const Points& points, const Pose& T_map_scan, const Values& values) {
    static_assert(
        is_point_range_v<Points>, "nvm: points must be a range of points: size(), [] and x, y, z");
    require(points.size() == values.size(), "values.size()", values.size(), "points.size()");
    return engine_.insert_unsided(points, T_map_scan, values);
  }

  // --- queries: const, noexcept, no allocation

  /// The nearest stored points in the 27 voxels (search.rings) around `point` (map frame, m) that
  /// agree with the unit `normal` (spec §3.6): surfaces within max_surface_angle, points within
  /// max_point_angle. Ascending by distance; of equally near points always the same one first.
  /// Writes to `out`, which has room for search.count, and returns how many. Only a sighting finds
  /// sightings, and normals too (sighting.hpp). Nothing is found for a bad point or a normal of
  /// another length.
  template <class = void>
  NVM_SHARED std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept {
    return engine_.nearest(normal, {point, search, out, context});
  }

  /// The same without normals: both sides.
  template <class = void>
  NVM_SHARED std::size_t nearest(
      const Eigen::Vector3d& point,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept {
    return engine_.nearest({point, search, out, context});
  }

  /// Calls visit(const Neighbor&) for every stored point within `radius` [m] of `center`, in no
  /// particular order; the radius may be of any size.
  template <class Visitor>
  NVM_SHARED void for_each_within(
      const Eigen::Vector3d& center, double radius, Visitor&& visit) const {
    engine_.for_each_within(center, radius, visit);
  }

  NVM_SHARED Eigen::Vector3d position(PointId id) const noexcept {
    return detail::stored_position(engine_.storage(), engine_.lattice(), id);
  }
  /// Unit normal of a stored point, its sighting, or zero when it was inserted without either.
  NVM_SHARED Eigen::Vector3f normal(PointId id) const noexcept {
    return detail::load_normal(detail::stored_normal(engine_.storage(), id));
  }
  /// 0: front surface of its voxel, 1: back, and so on.
  NVM_SHARED int side(PointId id) const noexcept { return detail::side_of(engine_.storage(), id); }

  /// What a stored point carries beside; zero what the map does not keep.
  NVM_SHARED PointValues values(PointId id) const noexcept {
    return detail::stored_values(engine_.storage(), engine_.options().columns, id);
  }

  /// Calls visit(const MapPoint&) for every stored point, in an order that depends only on the
  /// map's history.
  template <class Visitor>
  NVM_SHARED void for_each_point(Visitor&& visit) const {
    engine_.for_each_point(visit);
  }
  template <class = void>
  NVM_SHARED std::vector<MapPoint> points() const {
    std::vector<MapPoint> points;
    points.reserve(size());
    engine_.for_each_point(detail::Collector<MapPoint>{points});
    return points;
  }

  // --- erasing; all return the number of points erased

  /// Erases the points in the box from `min` to `max` [m], inclusive.
  template <class = void>
  NVM_SHARED std::size_t erase_box(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
    return engine_.erase_region(detail::BoxRegion{min, max});
  }
  /// Erases the points at most `radius` [m] from `center`.
  template <class = void>
  NVM_SHARED std::size_t erase_within(const Eigen::Vector3d& center, double radius) {
    return engine_.erase_region(detail::BallRegion{center, radius});
  }
  /// Erases the voxels whose centre is farther than `radius` [m] from `center`: what CT-LIO does
  /// after every scan.
  template <class = void>
  NVM_SHARED std::size_t erase_voxels_beyond(const Eigen::Vector3d& center, double radius) {
    return engine_.erase_voxels_beyond(center, radius);
  }
  /// The same as eviction, counted in the statistics of the scan that was inserted last: what a
  /// pipeline or host that bounds its map by distance calls after each scan, because only it knows
  /// where the sensor is.
  template <class = void>
  NVM_SHARED void keep_within(const Eigen::Vector3d& center, double radius, InsertStats& stats) {
    engine_.keep_within(center, radius, stats);
  }
  NVM_SHARED void clear() noexcept { engine_.clear(); }

  // --- size

  NVM_SHARED bool empty() const noexcept { return size() == 0; }
  /// Stored points.
  NVM_SHARED std::size_t size() const noexcept { return engine_.storage().point_count(); }
  NVM_SHARED std::size_t voxel_count() const noexcept { return engine_.storage().voxel_count(); }
  NVM_SHARED MapStats stats() const { return detail::count_all(engine_.storage()); }
  /// Memory in use, or once used and kept for reuse.
  NVM_SHARED std::size_t memory_bytes() const noexcept {
    return engine_.storage().memory_bytes() + sizeof(*this);
  }
  /// memory_bytes() never exceeds this.
  NVM_SHARED std::size_t memory_limit_bytes() const noexcept {
    return engine_.memory_limit_bytes() + sizeof(*this);
  }

 private:
  friend BasicMapArchive<VoxelMap>;
  friend BasicMapImage<VoxelMap>;

  detail::MapEngine engine_;
};

static_assert(is_map_v<VoxelMap>);

}  // namespace nvm
