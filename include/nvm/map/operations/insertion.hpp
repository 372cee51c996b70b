// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>

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

namespace nvm::detail {

/// Puts points into the storage by the rules of spec §3.3 to §3.5: which voxel, which of its
/// surfaces, whether there is room, and what has to go to make room.
class Insertion {
 public:
  Insertion(
      const MapOptions& options,
      const Lattice& lattice,
      const NormalGate& gate,
      VoxelStorage& storage,
      VoxelCache& cache)
      : options_(options),
        gate_(gate),
        min_sq_steps_(lattice.sq_steps(options.min_point_distance)),
        admission_(options, gate.min_surface_dot, min_sq_steps_, storage.chunks()),
        storage_(storage),
        chunks_(storage.chunks()),
        cache_(cache),
        merger_(options, min_sq_steps_, storage),
        number_(cache.begin_insertion()) {
    storage_.recency().begin_epoch();
  }

  /// Stores the first `count` points of the block; those without normal go to the front surface. A
  /// function of its own: among its caller's code it would run out of registers (15 instead of 13.5
  /// ns per point).
  [[gnu::noinline]] void insert(const PointBlock& block, std::size_t count) {
    look_ahead(block, count);
    for (std::size_t i = 0; i < count; ++i) {
      insert_one(block, i);
    }
  }

  /// Starts to load the voxels of the first `count` points, to make insert_one() faster.
  void look_ahead(const PointBlock& block, std::size_t count) noexcept {
    look_ahead_.start(block, count, cache_, storage_);
  }
  /// Stores point `i` of the block.
  void insert_one(const PointBlock& block, std::size_t i) {
    switch (block.status(i)) {
      case PointBlock::Status::kOk:
        insert_point(block, i);
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

  /// For judging points beforehand.
  const Admission& admission() const noexcept { return admission_; }
  /// Counts a point that its voxel rejects.
  void reject(Admissible reason) noexcept {
    ++(reason == Admissible::kTooClose ? stats_.too_close : stats_.surface_full);
  }

  InsertStats& stats() noexcept { return stats_; }

 private:
  void insert_point(const PointBlock& block, std::size_t i) {
    const IndexKey key = block.key(i);
    VoxelCache::Entry& cached = cache_[block.cache_slot(i)];
    if (cached.key != key || cached.insertion != number_) {
      const std::uint32_t found = cached.key == key
                                      ? cached.head
                                      : find_or_create(block.voxel(i), look_ahead_.brick_hint(i));
      if (found == kNone) {
        ++stats_.map_full;
        return;
      }
      storage_.recency().use(chunks_[found].voxel);
      cached = {key, found, number_};
    }
    const StoredNormal normal = block.normal(i);
    const std::uint32_t surface = surface_for(cached.head, normal);
    if (surface == kNone) {
      ++stats_.map_full;
      return;
    }
    add_to_surface(surface, block.wrapped(i), normal);
  }

  /// Head of the voxel's front surface, or kNone without room for the voxel. `brick_hint` is its
  /// brick, or any other.
  std::uint32_t find_or_create(const VoxelIndex& index, std::uint32_t brick_hint) {
    const IndexKey key = index_key(brick_index(index));
    std::uint32_t brick = storage_.find_brick(key, brick_hint);
    const std::uint32_t found = storage_.head_in(brick, cell_in_brick(index));
    if (found != kNone) {
      return found;
    }
    while (!has_room_for_voxel(brick)) {
      if (storage_.voxel_count() == 0) {
        return kNone;
      }
      evict(storage_.recency().oldest());
      brick = storage_.find_brick(key);
    }
    ++stats_.new_voxels;
    return storage_.create_voxel(index, brick);
  }

  /// Head of the surface that takes the normal, made when needed; kNone without room for it.
  std::uint32_t surface_for(std::uint32_t front, const StoredNormal& normal) {
    if (admission_.takes_any(front, normal)) {
      return front;
    }
    const SurfaceChoice choice = admission_.choose(front, normal);
    if (!choice.makes_new) {
      return choice.surface;
    }
    const std::uint32_t voxel = chunks_[front].voxel;
    if (!make_room_for_chunk(voxel)) {
      return kNone;
    }
    const std::uint32_t surface = storage_.create_surface(voxel, chunks_[front].wrapped(0));
    storage_.link_surface(choice.surface, surface);
    return surface;
  }

  void add_to_surface(std::uint32_t head, const WrappedPoint& point, const StoredNormal& normal) {
    const Room room = admission_.find_room(head, LanePoint(point));
    if (room.admissible != Admissible::kYes) {
      reject(room.admissible);
      if (room.admissible == Admissible::kTooClose && merger_.is_on()) {
        merger_.merge_into_nearest(room.chunk, point, normal);
      }
      return;
    }
    if (options_.space_across_voxels && is_neighbor_too_close(head, point, normal)) {
      ++stats_.too_close;
      return;
    }
    const int size = chunks_[head].size;
    const bool needs_chunk = size > 0 && size % kLanes == 0;
    if (needs_chunk && !make_room_for_chunk(chunks_[head].voxel)) {
      ++stats_.map_full;
      return;
    }
    storage_.append(head, room.chunk, point, normal);
    ++stats_.stored;
  }

  /// Whether a query at `point`, which goes to the surface at `head`, would find a point too close.
  bool is_neighbor_too_close(
      std::uint32_t head, const WrappedPoint& point, const StoredNormal& normal) noexcept {
    if (normal == StoredNormal{}) {
      return finds_any(NoGate{}, head, point, normal);
    }
    gate_.normal = normal;
    return finds_any(gate_, head, point, normal);
  }

  template <class Gate>
  [[gnu::noinline]] bool finds_any(
      const Gate& gate,
      std::uint32_t head,
      const WrappedPoint& point,
      const StoredNormal& normal) noexcept {
    const std::uint32_t voxel = chunks_[head].voxel;
    const LatticePoint place{
        storage_.index_of(voxel),
        {step_in_voxel(point.x), step_in_voxel(point.y), step_in_voxel(point.z)}};
    Candidates found(1);
    NearestQuery<Gate>(storage_, place, gate, false)
        .collect(storage_.brick_of(voxel), min_sq_steps_, found);
    if (found.count() > 0 && merger_.is_on()) {
      found.keep_nearest();
      const PointId nearest = found.id(0);
      merger_.merge(nearest / kLanes, static_cast<int>(nearest % kLanes), point, normal);
    }
    return found.count() > 0;
  }

  /// Room for a voxel in `brick`, or in a new brick for kNone.
  bool has_room_for_voxel(std::uint32_t brick) const noexcept {
    return !storage_.voxels_exhausted() && !storage_.chunks_exhausted() &&
           (brick != kNone || !storage_.bricks_exhausted());
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
  NormalGate gate_;
  std::int32_t min_sq_steps_;
  Admission admission_;
  VoxelStorage& storage_;
  const PointChunk* chunks_;  // copied from it: behind a reference it would be read again and again
  VoxelCache& cache_;
  PointMerger merger_;
  std::uint32_t number_;
  LookAhead look_ahead_;
  InsertStats stats_;
};

}  // namespace nvm::detail
