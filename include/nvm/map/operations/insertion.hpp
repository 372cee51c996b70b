// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "nvm/map/insert_stats.hpp"
#include "nvm/map/map_options.hpp"
#include "nvm/map/operations/candidates.hpp"
#include "nvm/map/operations/nearest_query.hpp"
#include "nvm/map/operations/point_block.hpp"
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
        storage_(storage),
        cache_(cache),
        number_(cache.begin_insertion()) {
    storage_.recency().begin_epoch();
  }

  /// Stores the first `count` points of the block; those without normal go to the front surface.
  void insert(const PointBlock& block, std::size_t count) {
    prefetch(block, count);
    for (std::size_t i = 0; i < count; ++i) {
      switch (block.status(i)) {
        case PointBlock::Status::kOk:
          insert(block.key(i), block.voxel(i), block.wrapped(i), block.normal(i));
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
  }

  InsertStats& stats() noexcept { return stats_; }

 private:
  /// Starts to load the voxels of the block that the cache does not know: a point in an unvisited
  /// place would otherwise wait for memory five times in a row.
  [[gnu::always_inline]] void prefetch(const PointBlock& block, std::size_t count) noexcept {
    std::array<VoxelIndex, PointBlock::kSize> voxels;
    std::array<std::uint32_t, PointBlock::kSize> places;  // bricks, then heads
    std::size_t unknown = 0;
    for (std::size_t i = 0; i < count; ++i) {
      voxels[unknown] = block.voxel(i);
      unknown += static_cast<std::size_t>(cache_.at(voxels[unknown]).key != block.key(i));
    }
    constexpr std::size_t kWorthwhile = 8;  // fewer wait for less than looking ahead takes
    if (unknown < kWorthwhile) {
      return;
    }
    for (std::size_t i = 0; i < unknown; ++i) {
      storage_.prefetch_slot(voxels[i]);
    }
    for (std::size_t i = 0; i < unknown; ++i) {
      places[i] = storage_.prefetch_head(voxels[i]);
    }
    for (std::size_t i = 0; i < unknown; ++i) {
      places[i] = storage_.prefetch_surface(places[i], voxels[i]);
    }
    for (std::size_t i = 0; i < unknown; ++i) {
      if (places[i] != kNone) {
        const PointChunk& head = storage_.chunk(places[i]);
        storage_.recency().prefetch(head.voxel);
        if (head.next != kNone) {
          storage_.prefetch_chunk(head.next);
        }
      }
    }
  }

  void insert(
      IndexKey key,
      const VoxelIndex& index,
      const WrappedPoint& point,
      const StoredNormal& normal) {
    VoxelCache::Entry& cached = cache_.at(index);
    if (cached.key != key || cached.insertion != number_) {
      const std::uint32_t found = cached.key == key ? cached.head : find_or_create(index);
      if (found == kNone) {
        ++stats_.map_full;
        return;
      }
      storage_.recency().use(storage_.chunk(found).voxel);
      cached = {key, found, number_};
    }
    const std::uint32_t head = cached.head;
    const std::uint32_t surface = surface_for(head, normal);
    if (surface == kNone) {
      ++stats_.map_full;
      return;
    }
    add_to_surface(surface, point, normal);
  }

  std::uint32_t find_or_create(const VoxelIndex& index) {
    const std::uint32_t found = storage_.find_voxel(index);
    if (found != kNone) {
      return found;
    }
    if (!make_room_for_voxel(index)) {
      return kNone;
    }
    ++stats_.new_voxels;
    return storage_.create_voxel(index);
  }

  /// The view-consistency judgment (paper III-B-1, spec §3.4). Head of the surface that takes the
  /// normal, made when needed; kNone without room for it.
  std::uint32_t surface_for(std::uint32_t front, const StoredNormal& normal) {
    if (normal == StoredNormal{} || storage_.chunk(front).size == 0) {
      return front;
    }
    const Choice choice = options_.surface_rule == SurfaceRule::kPaper
                              ? first_consistent(front, normal)
                              : smallest_angle(front, normal);
    if (!choice.makes_new) {
      return choice.surface;
    }
    const std::uint32_t voxel = storage_.chunk(front).voxel;
    if (!make_room_for_chunk(voxel)) {
      return kNone;
    }
    const std::uint32_t surface = storage_.create_surface(voxel);
    storage_.link_surface(choice.surface, surface);
    return surface;
  }

  struct Choice {
    std::uint32_t surface;
    bool makes_new;  // behind `surface`, which is the last one
  };

  /// The first surface that agrees with the normal; the last one takes whatever is left.
  Choice first_consistent(std::uint32_t front, const StoredNormal& normal) const noexcept {
    std::uint32_t surface = front;
    for (int count = 1;; ++count) {
      const PointChunk& chunk = storage_.chunk(surface);
      if (count == options_.max_surfaces || dot(chunk.direction, normal) > gate_.min_surface_dot) {
        return {surface, false};
      }
      if (chunk.next_surface == kNone) {
        return {surface, true};
      }
      surface = chunk.next_surface;
    }
  }

  Choice smallest_angle(std::uint32_t front, const StoredNormal& normal) const noexcept {
    int best_dot = std::numeric_limits<int>::min();
    std::uint32_t best = front;
    std::uint32_t last = front;
    int count = 0;
    for (std::uint32_t surface = front; surface != kNone;
         surface = storage_.chunk(surface).next_surface) {
      const int surface_dot = dot(storage_.chunk(surface).direction, normal);
      if (surface_dot > best_dot) {
        best_dot = surface_dot;
        best = surface;
      }
      last = surface;
      ++count;
    }
    const bool agrees = best_dot > gate_.min_surface_dot;
    return agrees || count == options_.max_surfaces ? Choice{best, false} : Choice{last, true};
  }

  void add_to_surface(std::uint32_t head, const WrappedPoint& point, const StoredNormal& normal) {
    const int size = storage_.chunk(head).size;
    if (size >= options_.points_per_surface) {
      ++stats_.surface_full;
      return;
    }
    const LanePoint lanes(point);
    std::uint32_t last = head;
    int left = size;
    for (std::uint32_t id = head; id != kNone; id = storage_.chunk(id).next, left -= kLanes) {
      IntLanes distances;
      sq_distances(storage_.chunk(id), lanes, distances);
      if ((lanes_below(distances, min_sq_steps_) & first_lanes(left)) != 0) {
        ++stats_.too_close;
        return;
      }
      last = id;
    }
    if (options_.space_across_voxels && is_neighbor_too_close(head, point, normal)) {
      ++stats_.too_close;
      return;
    }
    const bool needs_chunk = size > 0 && size % kLanes == 0;
    if (needs_chunk && !make_room_for_chunk(storage_.chunk(head).voxel)) {
      ++stats_.map_full;
      return;
    }
    storage_.append(head, last, point, normal);
    ++stats_.stored;
  }

  /// Whether a query at `point`, which goes to the surface at `head`, would find a point too close.
  bool is_neighbor_too_close(
      std::uint32_t head, const WrappedPoint& point, const StoredNormal& normal) noexcept {
    if (normal == StoredNormal{}) {
      return finds_any(NoGate{}, head, point);
    }
    gate_.normal = normal;
    return finds_any(gate_, head, point);
  }

  template <class Gate>
  bool finds_any(const Gate& gate, std::uint32_t head, const WrappedPoint& point) const noexcept {
    const std::uint32_t voxel = storage_.chunk(head).voxel;
    const LatticePoint place{
        storage_.index_of(voxel),
        {step_in_voxel(point.x), step_in_voxel(point.y), step_in_voxel(point.z)}};
    Candidates found(1);
    NearestQuery<Gate>(storage_, place, gate)
        .collect(storage_.brick_of(voxel), min_sq_steps_, found);
    return found.count() > 0;
  }

  bool make_room_for_voxel(const VoxelIndex& index) {
    const auto has_room = [&] {
      return !storage_.voxels_exhausted() && !storage_.chunks_exhausted() &&
             (!storage_.bricks_exhausted() ||
              storage_.find_brick(index_key(brick_index(index))) != kNone);
    };
    while (!has_room()) {
      if (storage_.voxel_count() == 0) {
        return false;
      }
      evict(storage_.recency().oldest());
    }
    return true;
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
  VoxelStorage& storage_;
  VoxelCache& cache_;
  std::uint32_t number_;
  InsertStats stats_;
};

}  // namespace nvm::detail
