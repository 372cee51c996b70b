// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "nvm/core/executor.hpp"
#include "nvm/core/point_access.hpp"
#include "nvm/core/require.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/insert_stats.hpp"
#include "nvm/map/map_concept.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/map_point.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/operations/erasure.hpp"
#include "nvm/map/operations/gated_nearest.hpp"
#include "nvm/map/operations/insertion.hpp"
#include "nvm/map/operations/nearest_query.hpp"
#include "nvm/map/operations/parallel_insertion.hpp"
#include "nvm/map/operations/point_block.hpp"
#include "nvm/map/operations/query_context.hpp"
#include "nvm/map/operations/traversal.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/map_capacity.hpp"
#include "nvm/map/storage/stored_normal.hpp"
#include "nvm/map/storage/voxel_cache.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm {

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
  explicit VoxelMap(const MapOptions& options = {})
      : options_((options.validate(), options)),
        lattice_(options.voxel_size),
        capacity_(detail::map_capacity(options)),
        storage_(capacity_),
        gate_(detail::normal_gate(options)) {}

  /// A map that was moved from is empty, keeps its options, and takes memory again when it is used.
  VoxelMap(VoxelMap&& other) noexcept
      : options_(other.options_),
        lattice_(other.lattice_),
        capacity_(other.capacity_),
        storage_(std::exchange(other.storage_, {})),
        gate_(other.gate_) {
    other.cache_.clear();
  }
  VoxelMap& operator=(VoxelMap&& other) noexcept {
    options_ = other.options_;
    lattice_ = other.lattice_;
    capacity_ = other.capacity_;
    storage_ = std::exchange(other.storage_, {});
    gate_ = other.gate_;
    cache_.clear();
    other.cache_.clear();
    return *this;
  }

  const MapOptions& options() const noexcept { return options_; }

  // --- insertion

  /// Inserts `points` with their `normals` (ranges of equal length, in the frame scan) at
  /// T_map_scan (Eq. 3): p_map = T p, n_map = R n. Normals have unit length and look at the sensor.
  /// Points that cannot be stored are counted, never an error. Throws std::invalid_argument when
  /// the lengths differ or T_map_scan is not rigid. 15 to 60 ns per point. From 65 536 points on,
  /// which take a millisecond, `executor` may read and judge them in several threads; the map has
  /// the same bits with any (see SerialExecutor).
  template <class Points, class Normals, class Executor = SerialExecutor>
  InsertStats insert(
      const Points& points,
      const Normals& normals,
      const Pose& T_map_scan = Pose::Identity(),
      const Executor& executor = {}) {
    static_assert(
        is_point_range_v<Points>, "nvm: points must be a range of points: size(), [] and x, y, z");
    static_assert(
        is_point_range_v<Normals>, "nvm: normals must be a range of 3-vectors as long as points");
    require(points.size() == normals.size(), "normals.size()", normals.size(), "points.size()");
    const auto fill = [&](std::size_t begin, std::size_t end, detail::PointBlock& block) {
      for (std::size_t i = begin; i < end; ++i) {
        block.set_position(i - begin, nvm::position(points[i]));
        block.set_normal(i - begin, nvm::position(normals[i]));
      }
      block.locate(T_map_scan, lattice_);
      block.turn_normals(T_map_scan);
    };
    return insert_blocks(static_cast<std::size_t>(points.size()), T_map_scan, fill, executor);
  }

  /// Inserts points without normals: all go to the front surface of their voxel, and only ungated
  /// queries find them. The baseline that cannot tell sides apart. Throws std::invalid_argument
  /// when T_map_scan is not rigid.
  template <class Points, class Executor = SerialExecutor>
  InsertStats insert_unsided(
      const Points& points,
      const Pose& T_map_scan = Pose::Identity(),
      const Executor& executor = {}) {
    static_assert(
        is_point_range_v<Points>, "nvm: points must be a range of points: size(), [] and x, y, z");
    const auto fill = [&](std::size_t begin, std::size_t end, detail::PointBlock& block) {
      for (std::size_t i = begin; i < end; ++i) {
        block.set_position(i - begin, nvm::position(points[i]));
      }
      block.locate(T_map_scan, lattice_);
      block.drop_normals();
    };
    return insert_blocks(static_cast<std::size_t>(points.size()), T_map_scan, fill, executor);
  }

  // --- queries: const, noexcept, no allocation

  /// The nearest stored points in the 27 voxels around `point` (map frame, m) that agree with the
  /// unit `normal` (spec §3.6): surfaces within max_surface_angle, points within max_point_angle.
  /// Ascending by distance; of equally near points always the same one first. Writes to `out`,
  /// which has room for search.count, and returns how many. Nothing is found for a point that is
  /// not finite or out of range, or a normal that is not a unit vector.
  std::size_t nearest(
      const Eigen::Vector3d& point,
      const Eigen::Vector3f& normal,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept {
    if (!detail::is_unit(normal)) {
      return 0;
    }
    detail::NormalGate gate = gate_;
    gate.normal = detail::store_normal(normal);
    const detail::NearestRequest request{point, search, out, context};
    return search.gate == Gate::kPoints
               ? detail::gated_nearest(storage_, lattice_, detail::PointGate{gate}, request)
               : detail::gated_nearest(storage_, lattice_, gate, request);
  }

  /// The same without normals: both sides.
  std::size_t nearest(
      const Eigen::Vector3d& point,
      const NearestSearch& search,
      Neighbor* out,
      QueryContext& context) const noexcept {
    return detail::gated_nearest(
        storage_, lattice_, detail::NoGate{}, {point, search, out, context});
  }

  /// Calls visit(const Neighbor&) for every stored point within `radius` [m] of `center`, in no
  /// particular order; the radius may be of any size.
  template <class Visitor>
  void for_each_within(const Eigen::Vector3d& center, double radius, Visitor&& visit) const {
    detail::for_each_within(storage_, lattice_, center, radius, visit);
  }

  Eigen::Vector3d position(PointId id) const noexcept {
    return detail::stored_position(storage_, lattice_, id);
  }
  /// Unit normal of a stored point; zero when it was inserted without one.
  Eigen::Vector3f normal(PointId id) const noexcept {
    return detail::load_normal(
        storage_.normals(id / detail::kLanes).get(static_cast<int>(id % detail::kLanes)));
  }
  /// 0: front surface of its voxel, 1: back, and so on.
  int side(PointId id) const noexcept { return detail::side_of(storage_, id); }

  /// Calls visit(const MapPoint&) for every stored point, in an order that depends only on the
  /// map's history.
  template <class Visitor>
  void for_each_point(Visitor&& visit) const {
    detail::for_each_point(storage_, lattice_, visit);
  }
  std::vector<MapPoint> points() const {
    std::vector<MapPoint> points;
    points.reserve(size());
    for_each_point([&](const MapPoint& point) { points.push_back(point); });
    return points;
  }

  // --- erasing; all return the number of points erased

  /// Erases the points in the box from `min` to `max` [m], inclusive.
  std::size_t erase_box(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
    return erase_region(detail::BoxRegion{min, max});
  }
  /// Erases the points at most `radius` [m] from `center`.
  std::size_t erase_within(const Eigen::Vector3d& center, double radius) {
    return erase_region(detail::BallRegion{center, radius});
  }
  /// Erases the voxels whose centre is farther than `radius` [m] from `center`: what CT-LIO does
  /// after every scan.
  std::size_t erase_voxels_beyond(const Eigen::Vector3d& center, double radius) {
    const std::size_t before = size();
    detail::erase_voxels_beyond(storage_, lattice_, center, radius);
    cache_.clear();
    return before - size();
  }
  /// The same as eviction, counted in the statistics of the scan that was inserted last: what a
  /// pipeline or host that bounds its map by distance calls after each scan, because only it knows
  /// where the sensor is.
  void keep_within(const Eigen::Vector3d& center, double radius, InsertStats& stats) {
    const std::size_t voxels = voxel_count();
    stats.evicted_points += erase_voxels_beyond(center, radius);
    stats.evicted_voxels += voxels - voxel_count();
  }
  void clear() noexcept {
    storage_.clear();
    cache_.clear();
  }

  // --- size

  bool empty() const noexcept { return size() == 0; }
  /// Stored points.
  std::size_t size() const noexcept { return storage_.point_count(); }
  std::size_t voxel_count() const noexcept { return storage_.voxel_count(); }
  MapStats stats() const { return detail::count_all(storage_); }
  /// Memory in use, or once used and kept for reuse.
  std::size_t memory_bytes() const noexcept { return storage_.memory_bytes() + sizeof(*this); }
  /// memory_bytes() never exceeds this.
  std::size_t memory_limit_bytes() const noexcept { return capacity_.bytes() + sizeof(*this); }

 private:
  friend class MapArchive;

  template <class Fill, class Executor>
  InsertStats insert_blocks(
      std::size_t size, const Pose& T_map_scan, const Fill& fill, const Executor& executor) {
    if (!is_rigid(T_map_scan)) {
      throw std::invalid_argument(
          "nvm: T_map_scan must be rigid: finite, with an orthonormal rotation");
    }
    if (!storage_.has_memory()) {
      storage_ = detail::VoxelStorage(capacity_);
    }
    detail::Insertion insertion(options_, lattice_, gate_, storage_, cache_);
    std::size_t inserted = 0;
    if constexpr (!std::is_same_v<Executor, SerialExecutor>) {
      using Parallel = detail::ParallelInsertion<Executor>;
      if (size >= Parallel::kMinPoints && options_.max_merged_points == 1) {
        inserted = Parallel(insertion, storage_, executor).insert(size, fill);
      }
    }
    detail::PointBlock block;
    for (std::size_t begin = inserted; begin < size; begin += detail::PointBlock::kSize) {
      const std::size_t end = std::min(begin + detail::PointBlock::kSize, size);
      fill(begin, end, block);
      insertion.insert(block, end - begin);
    }
    storage_.recency().begin_epoch();  // the queries that follow are more recent
    return insertion.stats();
  }

  template <class Region>
  std::size_t erase_region(const Region& region) {
    const std::size_t before = size();
    detail::erase_region(storage_, lattice_, region);
    cache_.clear();
    return before - size();
  }

  MapOptions options_;
  detail::Lattice lattice_;
  detail::MapCapacity capacity_;
  detail::VoxelStorage storage_;
  detail::VoxelCache cache_;
  detail::NormalGate gate_;
};

static_assert(is_map_v<VoxelMap>);

}  // namespace nvm
