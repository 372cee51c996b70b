// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_MAP_OPERATIONS_INSERTION_HPP  // a kernel: nvm/core/target.hpp
#define NVM_MAP_OPERATIONS_INSERTION_HPP

#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/geometry/pose.hpp"
#include "nvm/map/insert_stats.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/operations/admission.hpp"
#include "nvm/map/operations/candidates.hpp"
#include "nvm/map/operations/look_ahead.hpp"
#include "nvm/map/operations/nearest_query.hpp"
#include "nvm/map/operations/point_block.hpp"
#include "nvm/map/operations/point_merger.hpp"
#include "nvm/map/storage/lanes.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/stored_normal.hpp"
#include "nvm/map/storage/voxel_cache.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// Puts points into the storage by the rules of spec §3.3 to §3.5: which voxel, which of its
/// surfaces, whether there is room, and what has to go to make room.
template <class = void>
class BasicInsertion {
 public:
  BasicInsertion(
      const MapOptions& options,
      const Lattice& lattice,
      const NormalGate& gate,
      VoxelStorage& storage,
      VoxelCache& cache)
      : options_(options),
        lattice_(lattice),
        gate_(gate),
        min_sq_steps_(lattice.sq_steps(options.min_point_distance)),
        admission_(
            options, gate.min_surface_dot, min_sq_steps_, storage.chunks(), storage.normals()),
        storage_(storage),
        chunks_(storage.chunks()),
        cache_(cache),
        merger_(options, min_sq_steps_, storage),
        number_(cache.begin_insertion()) {
    storage_.recency().begin_epoch();
  }

  /// Brings the points of a block to the map frame, and their normals or none.
  [[gnu::noinline]] void locate(
      PointBlock& block, bool has_normals, const Pose& T_map_scan) const noexcept {
    block.locate(T_map_scan, lattice_);
    if (has_normals) {
      block.turn_normals(T_map_scan);
    } else {
      block.drop_normals();
    }
  }

  /// Stores the first `count` points of the block; those without normal go to the front surface. A
  /// function of its own: among its caller's code it would run out of registers (15 instead of 13.5
  /// ns per point).
  [[gnu::noinline]] void insert(const PointBlock& block, std::size_t count) {
    look_ahead_.start(block, count, cache_, storage_);
    for (std::size_t i = 0; i < count; ++i) {
      insert_one(block, i);
    }
  }

  const InsertStats& stats() const noexcept { return stats_; }

 private:
  /// Stores point `i` of the block.
  void insert_one(const PointBlock& block, std::size_t i) {
    switch (block.status(i)) {
      case PointBlock::Status::kOk:
        insert_point(block, i, block.normal(i));
        break;
      case PointBlock::Status::kSighting:
        insert_point(block, i, view_of(block.normal(i)));
        break;
      case PointBlock::Status::kNonFinite:
        ++stats_.non_finite;
        break;
      case PointBlock::Status::kOutOfRange:
        ++stats_.out_of_range;
        break;
      case PointBlock::Status::kNoNormal:
        ++stats_.no_normal;
        break;
    }
  }

  /// `facing` chooses the surface: the normal, or the view direction of a sighting.
  [[gnu::always_inline]] void insert_point(
      const PointBlock& block, std::size_t i, const StoredNormal& facing) {
    const IndexKey key = block.key(i);
    VoxelCache::Entry& cached = cache_[block.cache_slot(i)];
    if (cached.key != key || cached.insertion != number_) {
      const std::uint32_t found = cached.key == key ? cached.head : find_or_create(block, i);
      if (found == kNone) {
        return;
      }
      storage_.recency().use(chunks_[found].voxel);
      cached = {key, found, number_};
    }
    const std::uint32_t surface = surface_for(cached.head, facing, block, i);
    if (surface != kNone) {
      add_to_surface(surface, block, i);
    }
  }

  /// Head of the front surface of the point's voxel; kNone, which is counted, when the map has no
  /// room for the voxel or for its only point.
  std::uint32_t find_or_create(const PointBlock& block, std::size_t i) {
    const VoxelIndex index = block.voxel(i);
    const IndexKey key = index_key(brick_index(index));
    std::uint32_t brick = storage_.find_brick(key, look_ahead_.brick_hint(i));
    const std::uint32_t found = storage_.head_in(brick, cell_in_brick(index));
    if (found != kNone) {
      return found;
    }
    if (is_neighbor_too_close(brick, block, i)) {
      ++stats_.too_close;
      return kNone;
    }
    while (!storage_.has_room_for_voxel(brick)) {
      if (storage_.voxel_count() == 0) {
        ++stats_.map_full;
        return kNone;
      }
      evict(storage_.recency().oldest());
      brick = storage_.find_brick(key);
    }
    ++stats_.new_voxels;
    return storage_.create_voxel(index, brick);
  }

  /// Head of the surface that takes the point, made when needed; kNone, which is counted, when
  /// there is no room for the surface or for its only point.
  std::uint32_t surface_for(
      std::uint32_t front, const StoredNormal& facing, const PointBlock& block, std::size_t i) {
    if (admission_.takes_any(front, facing)) {
      return front;
    }
    const SurfaceChoice choice = admission_.choose(front, facing);
    if (!choice.makes_new) {
      return choice.surface;
    }
    const std::uint32_t voxel = chunks_[front].voxel;
    if (is_neighbor_too_close(storage_.brick_of(voxel), block, i)) {
      ++stats_.too_close;
      return kNone;
    }
    if (!make_room_for_chunk(voxel)) {
      ++stats_.map_full;
      return kNone;
    }
    const std::uint32_t surface = storage_.create_surface(voxel, chunks_[front].wrapped(0));
    storage_.link_surface(choice.surface, surface);
    return surface;
  }

  void reject(Admissible reason) noexcept {
    ++(reason == Admissible::kTooClose ? stats_.too_close : stats_.surface_full);
  }

  void add_to_surface(std::uint32_t head, const PointBlock& block, std::size_t i) {
    const WrappedPoint point = block.wrapped(i);
    const StoredNormal normal = block.normal(i);
    const Room room = admission_.find_room(head, LanePoint(point));
    if (room.admissible != Admissible::kYes) {
      const SightedPlace place = admission_.find_sighting(head, room, LanePoint(point), normal);
      if (place.chunk != kNone) {
        storage_.settle(head, place.chunk, place.lane, point, normal);
        storage_.set_row(place.chunk, place.lane, block.row(i));
        ++stats_.settled;
        return;
      }
      reject(room.admissible);
      if (room.admissible == Admissible::kTooClose && merger_.is_on()) {
        merger_.merge_into_nearest(room.chunk, point, normal);
      }
      return;
    }
    const int size = chunks_[head].size;
    if (size > 0 && is_neighbor_too_close(storage_.brick_of(chunks_[head].voxel), block, i)) {
      ++stats_.too_close;  // (that a new surface's first point is not was known before it was made)
      return;
    }
    const bool needs_chunk = size > 0 && size % kLanes == 0;
    if (needs_chunk && !make_room_for_chunk(chunks_[head].voxel)) {
      ++stats_.map_full;
      return;
    }
    const std::uint32_t chunk = storage_.append(head, room.chunk, point, normal);
    storage_.set_row(chunk, size % kLanes, block.row(i));
    ++stats_.stored;
  }

  /// With space_across_voxels: whether a query at the point, whose voxel lies in `brick` (or
  /// kNone), would find a point too close.
  bool is_neighbor_too_close(std::uint32_t brick, const PointBlock& block, std::size_t i) noexcept {
    if (!options_.space_across_voxels) {
      return false;
    }
    const StoredNormal normal = block.normal(i);
    return normal == StoredNormal{} ? finds_any(NoGate{}, brick, block, i)
                                    : finds_any(gate_for(gate_, normal), brick, block, i);
  }

  template <class Gate>
  [[gnu::noinline]] bool finds_any(
      const Gate& gate, std::uint32_t brick, const PointBlock& block, std::size_t i) noexcept {
    const WrappedPoint point = block.wrapped(i);
    const LatticePoint place{
        block.voxel(i), {step_in_voxel(point.x), step_in_voxel(point.y), step_in_voxel(point.z)}};
    Candidates<> found(1);
    NearestQuery<Gate>(storage_, place, gate, false).collect(brick, min_sq_steps_, found);
    if (found.count() > 0 && merger_.is_on()) {
      found.keep_nearest();
      const PointId nearest = found.id(0);
      merger_.merge(nearest / kLanes, static_cast<int>(nearest % kLanes), point, block.normal(i));
    }
    return found.count() > 0;
  }

  /// Never evicts `voxel`, which is about to grow.
  bool make_room_for_chunk(std::uint32_t voxel) {
    while (storage_.chunks_exhausted()) {
      if (storage_.voxel_count() == 1) {
        return false;
      }
      std::uint32_t oldest = storage_.recency().oldest();
      if (oldest == voxel) {  // all voxels were used in this epoch
        storage_.recency().remove(voxel);
        oldest = storage_.recency().oldest();
        storage_.recency().add(voxel);
      }
      evict(oldest);
    }
    return true;
  }

  void evict(std::uint32_t voxel) {
    stats_.evicted_points += storage_.point_count(voxel);
    ++stats_.evicted_voxels;
    cache_.forget(storage_.index_of(voxel));
    storage_.erase_voxel(voxel);
  }

  const MapOptions& options_;
  const Lattice& lattice_;
  NormalGate gate_;
  std::int32_t min_sq_steps_;
  Admission<> admission_;
  VoxelStorage& storage_;
  const PointChunk* chunks_;  // copied from it: behind a reference it would be read again and again
  VoxelCache& cache_;
  PointMerger<> merger_;
  std::uint32_t number_;
  LookAhead look_ahead_;
  InsertStats stats_;
};

using Insertion = BasicInsertion<>;

NVM_END_DETAIL_KERNELS

#endif  // NVM_MAP_OPERATIONS_INSERTION_HPP
