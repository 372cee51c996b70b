// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "nvm/core/assert.hpp"
#include "nvm/core/target.hpp"
#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/brick_table.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/map_capacity.hpp"
#include "nvm/map/storage/pool.hpp"
#include "nvm/map/storage/recency.hpp"
#include "nvm/map/storage/surface_storage.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Where things lie: bricks of voxels, chunks of points, and the order of use. Keeps the links
/// between them right; knows no rule of what belongs where. docs/map_layout.md has the drawing.
class VoxelStorage : public SurfaceStorage {
  // Where a free element keeps the index of the next free one.
  auto voxel_link() noexcept {
    return [this](std::uint32_t i) -> std::uint32_t& { return places_[i]; };
  }
  auto brick_link() noexcept {
    return [this](std::uint32_t i) -> std::uint32_t& { return bricks_[i].head[0]; };
  }

 public:
  /// Empty, with room for nothing and no memory.
  VoxelStorage() = default;
  explicit VoxelStorage(const MapCapacity& capacity)
      : SurfaceStorage(capacity),
        voxel_ids_(capacity.voxels),
        brick_ids_(capacity.bricks),
        places_(allocate_uninitialized<std::uint32_t>(capacity.voxels)),
        recency_(capacity.voxels),
        bricks_(allocate_uninitialized<Brick>(capacity.bricks)) {}

  // --- reading

  /// The brick at `address`, or kNone.
  std::uint32_t find_brick(const BrickAddress& address) const noexcept {
    return table_.find(address);
  }
  /// True when `brick` is, still, the brick with `key`.
  bool is_brick(std::uint32_t brick, IndexKey key) const noexcept {
    return brick < brick_ids_.high_water() && bricks_[brick].key == key;
  }
  /// The brick with `key`, or kNone; `hint` is probably the one.
  std::uint32_t find_brick(IndexKey key, std::uint32_t hint) const noexcept {
    return is_brick(hint, key) ? hint : find_brick(key);
  }
  bool has_memory() const noexcept { return bricks_ != nullptr; }
  const Brick* bricks() const noexcept { return bricks_.get(); }
  /// Starts to load the whole of a brick (or none).
  [[gnu::always_inline]] void prefetch_brick(std::uint32_t id) const noexcept {
    for (std::size_t line = 0; line < sizeof(Brick) && id != kNone; line += 64) {
      __builtin_prefetch(reinterpret_cast<const char*>(&bricks_[id]) + line);
    }
  }

  /// Head chunk of the front surface in a cell of a brick (or none); kNone when there is no voxel.
  std::uint32_t head_in(std::uint32_t brick, int cell) const noexcept {
    return brick == kNone || !bricks_[brick].has(cell)
               ? kNone
               : bricks_[brick].head[static_cast<std::size_t>(cell)];
  }

  // Where looking for a voxel, and what follows, waits for memory, step by step; hints that change
  // nothing. Each step reads what the one before has loaded, so that a caller who takes each step
  // for many voxels before the next waits once for all of them.

  [[gnu::always_inline]] void prefetch_slot(const BrickAddress& address) const noexcept {
    table_.prefetch(address);
  }
  /// The brick at `address`, or kNone.
  [[gnu::always_inline]] std::uint32_t prefetch_head(
      const BrickAddress& address, int cell) const noexcept {
    const std::uint32_t id = table_.find(address);
    if (id != kNone) {
      __builtin_prefetch(&bricks_[id].occupied);
      __builtin_prefetch(&bricks_[id].head[static_cast<std::size_t>(cell)]);
    }
    return id;
  }
  /// What head_in() says.
  [[gnu::always_inline]] std::uint32_t prefetch_surface(
      std::uint32_t brick, int cell) const noexcept {
    const std::uint32_t head = head_in(brick, cell);
    if (head != kNone) {
      prefetch_chunk(head);
    }
    return head;
  }

  VoxelIndex index_of(std::uint32_t voxel) const noexcept {
    return voxel_index(
        bricks_[places_[voxel] / kBrickCells].key, static_cast<int>(places_[voxel] % kBrickCells));
  }
  std::uint32_t brick_of(std::uint32_t voxel) const noexcept {
    return places_[voxel] / kBrickCells;
  }
  std::uint32_t head_of(std::uint32_t voxel) const noexcept {
    return bricks_[places_[voxel] / kBrickCells].head[places_[voxel] % kBrickCells];
  }

  using SurfaceStorage::point_count;
  /// Points in all surfaces of `voxel`.
  std::size_t point_count(std::uint32_t voxel) const noexcept {
    std::size_t count = 0;
    for (std::uint32_t head = head_of(voxel); head != kNone; head = chunk(head).next_surface) {
      count += chunk(head).size;
    }
    return count;
  }

  /// Calls visit(head, index) for each voxel, in an order that depends only on the map's history.
  template <class Visitor>
  void for_each_voxel(Visitor&& visit) const {
    for (std::uint32_t id = 0; id < brick_ids_.high_water(); ++id) {
      visit_brick(id, visit);
    }
  }
  template <class Visitor>
  void visit_brick(std::uint32_t id, Visitor&& visit) const {
    const IndexKey key = bricks_[id].key;
    if (key == 0) {
      return;
    }
    for (std::uint64_t cells = bricks_[id].occupied; cells != 0; cells &= cells - 1) {
      const int cell = __builtin_ctzll(cells);
      visit(bricks_[id].head[static_cast<std::size_t>(cell)], voxel_index(key, cell));
    }
  }
  /// All bricks have ids below this.
  std::uint32_t brick_high_water() const noexcept { return brick_ids_.high_water(); }

  std::size_t voxel_count() const noexcept { return voxel_ids_.taken(); }
  std::size_t brick_count() const noexcept { return brick_ids_.taken(); }
  /// All voxels have ids below this.
  std::uint32_t voxel_high_water() const noexcept { return voxel_ids_.high_water(); }
  const Recency& recency() const noexcept { return recency_; }
  Recency& recency() noexcept { return recency_; }

  /// Bytes in use or once used and kept for reuse.
  std::size_t memory_bytes() const noexcept {
    return voxel_ids_.high_water() * sizeof(std::uint32_t) +
           recency_.used_bytes(voxel_ids_.high_water()) + brick_ids_.high_water() * sizeof(Brick) +
           table_.bytes() + chunk_bytes();
  }

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor& visitor) {
    SurfaceStorage::visit_state(self, visitor);
    IndexAllocator::visit_state(self.voxel_ids_, visitor);
    IndexAllocator::visit_state(self.brick_ids_, visitor);
    const std::uint32_t voxels = self.voxel_high_water();
    visitor.array(self.places_, voxels, self.voxel_ids_.capacity());
    Recency::visit_state(self.recency_, visitor, voxels, self.voxel_ids_.capacity());
    BrickTable::visit_state(self.table_, visitor);
    visitor.array(self.bricks_, self.brick_high_water(), self.brick_ids_.capacity());
  }

  // --- changing

  /// Whether `points` points fit, wherever they are.
  bool has_room_for(std::size_t points) const noexcept {
    return voxel_ids_.left() >= points && brick_ids_.left() >= points && chunks_left() >= points;
  }
  /// Room for a voxel in `brick`, or in a new brick for kNone.
  bool has_room_for_voxel(std::uint32_t brick) const noexcept {
    return !voxel_ids_.exhausted() && !chunks_exhausted() &&
           (brick != kNone || !brick_ids_.exhausted());
  }

  /// Makes the voxel `index`, used now, with an empty front surface, and returns its head. There
  /// must be no such voxel, and room for a voxel, a chunk and, unless it exists, `brick`: the brick
  /// of the voxel, or kNone to make it. Throws std::bad_alloc, changing nothing.
  std::uint32_t create_voxel(const VoxelIndex& index, std::uint32_t brick) {
    const std::uint32_t head = place_voxel(index, brick);
    recency_.add(chunk(head).voxel);
    return head;
  }

  /// The same for a voxel read from a file, with the standing that it had. kNone when that is
  /// impossible.
  std::uint32_t restore_voxel(
      const VoxelIndex& index, std::uint32_t brick, std::uint32_t listed, std::uint32_t stamp) {
    const std::uint32_t head = place_voxel(index, brick);
    return recency_.restore({chunk(head).voxel, listed, stamp}) ? head : kNone;
  }

  /// Makes `head` the front surface of its voxel.
  void set_front(std::uint32_t head) noexcept {
    const std::uint32_t place = places_[chunk(head).voxel];
    bricks_[place / kBrickCells].head[place % kBrickCells] = head;
  }

  void erase_voxel(std::uint32_t voxel) noexcept {
    for (std::uint32_t head = head_of(voxel); head != kNone;) {
      const std::uint32_t next = chunk(head).next_surface;
      release_surface(head);
      head = next;
    }
    forget_voxel(voxel);
  }

  void clear() noexcept {
    for (std::uint32_t id = 0; id < brick_ids_.high_water(); ++id) {
      if (bricks_[id].key != 0) {
        table_.erase(bricks_[id].key);
      }
    }
    voxel_ids_.clear();
    brick_ids_.clear();
    clear_surfaces();
    recency_.clear();
  }

  /// Removes a voxel whose surfaces have all been released.
  void forget_voxel(std::uint32_t voxel) noexcept {
    const std::uint32_t id = places_[voxel] / kBrickCells;
    bricks_[id].occupied &= ~(std::uint64_t{1} << places_[voxel] % kBrickCells);
    recency_.remove(voxel);
    voxel_ids_.give_back(voxel, voxel_link());
    if (bricks_[id].occupied == 0) {
      erase_brick(id);
    }
  }

 private:
  std::uint32_t place_voxel(const VoxelIndex& index, std::uint32_t brick) {
    if (brick == kNone) {
      brick = create_brick(brick_index(index));
    }
    const std::uint32_t voxel = voxel_ids_.take(voxel_link());
    const std::uint32_t head = create_surface(voxel, wrap(LatticePoint{index, {0, 0, 0}}));
    const auto cell = static_cast<std::uint32_t>(cell_in_brick(index));
    places_[voxel] = brick * kBrickCells + cell;
    bricks_[brick].head[cell] = head;
    bricks_[brick].occupied |= std::uint64_t{1} << cell;
    return head;
  }

  std::uint32_t create_brick(const VoxelIndex& index) {
    const IndexKey key = index_key(index);
    const std::uint32_t id = brick_ids_.take(brick_link());
    NVM_ASSERT(id != kNone);
    try {
      table_.insert(key, id);
    } catch (...) {
      bricks_[id].key = 0;
      brick_ids_.give_back(id, brick_link());
      throw;
    }
    bricks_[id].occupied = 0;
    bricks_[id].key = key;
    link_neighbors(id, index);
    return id;
  }

  void link_neighbors(std::uint32_t id, const VoxelIndex& index) noexcept {
    constexpr std::size_t kMiddle = kBricksAround / 2;
    for (std::size_t slot = 0; slot < kBricksAround; ++slot) {
      const VoxelIndex other = index_around(index, static_cast<int>(slot));
      const std::uint32_t neighbor = slot == kMiddle ? id : table_.find(index_key(other));
      bricks_[id].around[slot] = neighbor;
      if (neighbor != kNone) {
        bricks_[neighbor].around[kBricksAround - 1 - slot] = id;
      }
    }
  }

  void erase_brick(std::uint32_t id) noexcept {
    for (std::size_t slot = 0; slot < kBricksAround; ++slot) {
      const std::uint32_t neighbor = bricks_[id].around[slot];
      if (neighbor != kNone) {
        bricks_[neighbor].around[kBricksAround - 1 - slot] = kNone;
      }
    }
    table_.erase(bricks_[id].key);
    bricks_[id].key = 0;
    brick_ids_.give_back(id, brick_link());
  }

  IndexAllocator voxel_ids_;
  IndexAllocator brick_ids_;
  RawArray<std::uint32_t> places_;  // of a voxel: brick * kBrickCells + cell
  Recency recency_;
  BrickTable table_;
  RawArray<Brick> bricks_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
