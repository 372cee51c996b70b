// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "nvm/core/assert.hpp"
#include "nvm/core/target.hpp"
#include "nvm/map/storage/lanes.hpp"
#include "nvm/map/storage/map_capacity.hpp"
#include "nvm/map/storage/point_chunk.hpp"
#include "nvm/map/storage/pool.hpp"
#include "nvm/map/storage/principal_direction.hpp"
#include "nvm/map/storage/value_row.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// The chunks of all surfaces, with their normals and principal directions. Which voxel a surface
/// belongs to is VoxelStorage's business.
class SurfaceStorage {
  // Where a free chunk keeps the index of the next free one.
  auto chunk_link() noexcept {
    return [this](std::uint32_t i) -> std::uint32_t& { return chunks_[i].next; };
  }

 public:
  SurfaceStorage() = default;
  explicit SurfaceStorage(const MapCapacity& capacity)
      : bytes_per_chunk_(capacity.bytes_per_chunk()),
        row_bytes_(capacity.row_bytes),
        chunk_ids_(capacity.chunks),
        chunks_(allocate_uninitialized<PointChunk>(capacity.chunks)),
        normals_(allocate_uninitialized<NormalChunk>(capacity.chunks)),
        merged_(
            capacity.counts_merged ? allocate_uninitialized<MergedCounts>(capacity.chunks)
                                   : nullptr),
        rows_(
            capacity.row_bytes > 0
                ? allocate_uninitialized<std::uint8_t>(capacity.chunks * row_bytes_per_chunk())
                : nullptr) {}

  const PointChunk* chunks() const noexcept { return chunks_.get(); }
  const NormalChunk* normals() const noexcept { return normals_.get(); }
  const PointChunk& chunk(std::uint32_t id) const noexcept { return chunks_[id]; }
  const NormalChunk& normals(std::uint32_t chunk) const noexcept { return normals_[chunk]; }
  bool counts_merged() const noexcept { return merged_ != nullptr; }
  /// How many points the one in `lane` stands for. Only with MapCapacity::counts_merged.
  int merged_points(std::uint32_t chunk, int lane) const noexcept { return merged_[chunk][lane]; }
  /// True when no point of a chunk stands for fewer than `count`. Only with counts_merged.
  bool all_stand_for(std::uint32_t chunk, int count) const noexcept {
    std::uint8_t fewest = kNothingToMerge;
    for (const std::uint8_t merged : merged_[chunk]) {
      fewest = std::min(fewest, merged);
    }
    return fewest >= count;
  }
  /// The values of a point; nothing is copied where the map keeps none.
  void get_row(std::uint32_t chunk, int lane, ValueRow& row) const noexcept {
    if (row_bytes_ > 0) {
      std::memcpy(row.data(), &rows_[row_begin(chunk, lane)], row_bytes_);
    }
  }
  void set_row(std::uint32_t chunk, int lane, const ValueRow& row) noexcept {
    if (row_bytes_ > 0) {
      std::memcpy(&rows_[row_begin(chunk, lane)], row.data(), row_bytes_);
    }
  }
  /// Starts to load what an append to the surface at `head` touches.
  [[gnu::always_inline]] void prefetch_chunk(std::uint32_t head) const noexcept {
    __builtin_prefetch(&chunks_[head]);
    __builtin_prefetch(&normals_[head]);
    __builtin_prefetch(&normals_[head].power_step);
  }
  /// Points in all surfaces.
  std::size_t point_count() const noexcept { return point_count_; }
  std::size_t chunks_left() const noexcept { return chunk_ids_.left(); }
  bool chunks_exhausted() const noexcept { return chunk_ids_.exhausted(); }

  /// An empty surface of `voxel`, which `inside` is a point of, not linked to the others yet. There
  /// must be room for a chunk.
  std::uint32_t create_surface(std::uint32_t voxel, const WrappedPoint& inside) noexcept {
    const std::uint32_t head = take_chunk(voxel, inside);
    PointChunk& chunk = chunks_[head];
    chunk.next_surface = kNone;
    chunk.direction = {};
    chunk.size = 0;
    chunk.tight = 0;
    return head;
  }
  void link_surface(std::uint32_t last_head, std::uint32_t head) noexcept {
    chunks_[last_head].next_surface = head;
  }

  /// Adds a point to the surface at `head`, whose last chunk is `last`. There must be room for a
  /// chunk when `last` is full. The principal direction is up to date afterwards. Returns the new
  /// last chunk. The point's values are the caller's business, here and in settle().
  std::uint32_t append(
      std::uint32_t head,
      std::uint32_t last,
      const WrappedPoint& point,
      const StoredNormal& normal) noexcept {
    PointChunk& surface = chunks_[head];
    const int lane = surface.size % kLanes;
    if (lane == 0 && surface.size > 0) {
      const std::uint32_t added = take_chunk(surface.voxel, point);
      chunks_[last].next = added;
      last = added;
    }
    chunks_[last].set_position(lane, point);
    normals_[last].set(lane, normal);
    if (merged_ != nullptr) {
      merged_[last][lane] = 1;
    }
    surface.size = static_cast<std::uint8_t>((surface.size + 1) & 0x7f);
    if (is_sighting(normal)) {
      add_sighting(head, normal);
    } else {
      update_direction(head, normal);
    }
    ++point_count_;
    return last;
  }

  /// Moves a point, which then stands for one point more. Only with MapCapacity::counts_merged.
  void replace(std::uint32_t chunk, int lane, const WrappedPoint& point) noexcept {
    chunks_[chunk].set_position(lane, point);
    ++merged_[chunk][lane];
  }

  /// For a point read from a file. Only with MapCapacity::counts_merged.
  void restore_merged_points(std::uint32_t chunk, int lane, int count) noexcept {
    merged_[chunk][lane] = static_cast<std::uint8_t>(count);
  }

  /// Puts a point with a normal in the place of a sighting of the surface at `head`.
  void settle(
      std::uint32_t head,
      std::uint32_t chunk,
      int lane,
      const WrappedPoint& point,
      const StoredNormal& normal) noexcept {
    chunks_[chunk].set_position(lane, point);
    normals_[chunk].set(lane, normal);
    turn(chunks_[head], normals_[head].power_step, false);
  }

  /// Returns all chunks of a surface. Whatever links to it must be changed by the caller.
  void release_surface(std::uint32_t head) noexcept {
    point_count_ -= chunks_[head].size;
    for (std::uint32_t id = head; id != kNone;) {
      const std::uint32_t next = chunks_[id].next;
      chunk_ids_.give_back(id, chunk_link());
      id = next;
    }
  }

  /// Shows all that an image of the map must hold, for reading or writing (map_image.hpp).
  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor& visitor) {
    IndexAllocator::visit_state(self.chunk_ids_, visitor);
    visitor.number(self.point_count_, self.chunk_ids_.taken() * std::size_t{kLanes});
    const std::size_t used = self.chunk_ids_.high_water();
    visitor.array(self.chunks_, used, self.chunk_ids_.capacity());
    visitor.array(self.normals_, used, self.chunk_ids_.capacity());
    if (self.counts_merged()) {
      visitor.array(self.merged_, used, self.chunk_ids_.capacity());
    }
    if (self.row_bytes_ > 0) {
      const std::size_t bytes = self.row_bytes_per_chunk();
      visitor.array(self.rows_, used * bytes, self.chunk_ids_.capacity() * bytes);
    }
  }

 protected:
  std::size_t chunk_bytes() const noexcept { return chunk_ids_.high_water() * bytes_per_chunk_; }
  void clear_surfaces() noexcept {
    chunk_ids_.clear();
    point_count_ = 0;
  }

 private:
  std::uint32_t take_chunk(std::uint32_t voxel, const WrappedPoint& inside) noexcept {
    const std::uint32_t id = chunk_ids_.take(chunk_link());
    NVM_ASSERT(id != kNone);
    chunks_[id].next = kNone;
    chunks_[id].voxel = voxel;
    chunks_[id].clear_lanes(inside);
    if (merged_ != nullptr) {
      std::fill_n(merged_[id], kLanes, kNothingToMerge);
    }
    return id;
  }

  std::size_t row_bytes_per_chunk() const noexcept { return kLanes * row_bytes_; }
  std::size_t row_begin(std::uint32_t chunk, int lane) const noexcept {
    return (std::size_t{chunk} * kLanes + static_cast<std::size_t>(lane)) * row_bytes_;
  }

  /// After a sighting has joined the surface, whose direction it is only as long as it is alone.
  void add_sighting(std::uint32_t head, const StoredNormal& added) noexcept {
    PointChunk& surface = chunks_[head];
    surface.tight = 0;
    if (surface.size == 1) {
      surface.direction = view_of(added);
      normals_[head].power_step = {};
    }
  }

  /// After the normal `added` has joined the surface.
  void update_direction(std::uint32_t head, const StoredNormal& added) noexcept {
    PointChunk& surface = chunks_[head];
    PowerStep& step = normals_[head].power_step;
    if (surface.size == 1) {
      surface.direction = added;
      surface.tight = 1;
      step = {};
      step.add(added, dot(added, added));
      return;
    }
    const int along = dot(added, surface.direction);
    step.add(added, along);
    if (along > 0 && is_principal(step, surface.direction, surface.size)) {
      // Still: the usual case. Its sign is right, because the sum came to lie nearer to it.
      surface.tight = surface.tight != 0 && along > kTightDot ? 1 : 0;
    } else if (added == StoredNormal{}) {
      surface.tight = 0;
    } else {
      turn(surface, step, surface.tight != 0 && along > kTightDot);
    }
  }

  /// Finds the direction anew.
  [[gnu::noinline]] void turn(PointChunk& surface, PowerStep& step, bool is_tight) noexcept {
    if (is_tight) {  // a step of the power iteration is all it takes, and keeps the sign
      surface.direction = store_direction(wide(step));
      survey(surface, step);
      if (is_principal(step, surface.direction, surface.size)) {
        return;
      }
    }
    NormalSums sums;
    for_each_normals(surface, [&](const NormalChunk& normals, int count) {
      for (int lane = 0; lane < count; ++lane) {
        sums.add(normals.get(lane));
      }
    });
    surface.direction = principal_direction(sums);
    survey(surface, step);
  }

  /// Looks at all normals of a surface from its direction: the power step, and whether it is tight.
  void survey(PointChunk& surface, PowerStep& step) const noexcept {
    const StoredNormal direction = surface.direction;
    step = {};
    int min_along = std::numeric_limits<int>::max();
    for_each_normals(surface, [&](const NormalChunk& normals, int count) {
      for (int lane = 0; lane < kLanes; ++lane) {  // all lanes, without a branch
        const StoredNormal normal = normals.get(lane);
        const int along = dot(normal, direction);
        step.add(normal, lane < count && !is_sighting(normal) ? along : 0);
        min_along = std::min(min_along, lane < count ? along : min_along);
      }
    });
    surface.tight = min_along > kTightDot ? 1 : 0;
  }

  /// Calls visit(normals, count) for each chunk of a surface.
  template <class Visitor>
  void for_each_normals(const PointChunk& head, Visitor&& visit) const noexcept {
    int left = head.size;
    for (const PointChunk* chunk = &head; left > 0; chunk = &chunks_[chunk->next], left -= kLanes) {
      visit(normals_[static_cast<std::size_t>(chunk - chunks_.get())], std::min(left, kLanes));
    }
  }

  using MergedCounts = std::uint8_t[kLanes];
  static constexpr std::uint8_t kNothingToMerge = 255;  // of a lane without a point

  std::size_t bytes_per_chunk_ = 0;
  std::size_t row_bytes_ = 0;
  IndexAllocator chunk_ids_;
  RawArray<PointChunk> chunks_;
  RawArray<NormalChunk> normals_;
  RawArray<MergedCounts> merged_;  // null unless they are counted
  RawArray<std::uint8_t> rows_;    // null without values
  std::size_t point_count_ = 0;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
