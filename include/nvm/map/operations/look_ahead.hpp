// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/operations/point_block.hpp"
#include "nvm/map/storage/voxel_cache.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Starts to load the voxels of a block that the cache does not know, level by level: a point in an
/// unvisited place would otherwise wait for memory five times in a row.
class LookAhead {
 public:
  static constexpr std::size_t kWorthwhile = 8;  // fewer wait for less than looking ahead takes

  [[gnu::always_inline]] void start(
      const PointBlock& block,
      std::size_t count,
      VoxelCache& cache,
      const VoxelStorage& storage) noexcept {
    bricks_.fill(kNone);
    const std::size_t unknown = find_unknown(block, count, cache);
    if (unknown < kWorthwhile) {
      return;
    }
    const auto for_each = [&](const auto& visit) {
      std::for_each_n(unknown_.begin(), unknown, visit);
    };
    for_each([&](Unknown& voxel) {
      const VoxelIndex index = block.voxel(voxel.point);
      voxel.cell = cell_in_brick(index);
      voxel.address = index_key(brick_index(index));
      storage.prefetch_slot(voxel.address);
    });
    for_each([&](const Unknown& voxel) {
      bricks_[voxel.point] = storage.prefetch_head(voxel.address, voxel.cell);
    });
    for_each([&](Unknown& voxel) {
      voxel.head = storage.prefetch_surface(bricks_[voxel.point], voxel.cell);
    });
    for_each([&](const Unknown& voxel) { prefetch_end(storage, voxel.head); });
  }

  /// The brick of point `i`, or any other: it may not have been looked up, or is gone.
  std::uint32_t brick_hint(std::size_t i) const noexcept { return bricks_[i]; }

 private:
  struct Unknown {
    std::size_t point;
    BrickAddress address;
    int cell;
    std::uint32_t head;
  };

  /// Fills `unknown_` and returns how many there are.
  std::size_t find_unknown(const PointBlock& block, std::size_t count, VoxelCache& cache) noexcept {
    std::size_t unknown = 0;
    for (std::size_t i = 0; i < count; ++i) {  // without a branch
      unknown_[unknown].point = i;
      unknown += static_cast<std::size_t>(cache[block.cache_slot(i)].key != block.key(i));
    }
    return unknown;
  }

  /// Where an append to the surface at `head` (or none) ends.
  static void prefetch_end(const VoxelStorage& storage, std::uint32_t head) noexcept {
    if (head == kNone) {
      return;
    }
    const PointChunk& chunk = storage.chunk(head);
    storage.recency().prefetch(chunk.voxel);
    if (chunk.next != kNone) {
      storage.prefetch_chunk(chunk.next);
    }
  }

  std::array<Unknown, PointBlock::kSize> unknown_;
  std::array<std::uint32_t, PointBlock::kSize> bricks_{};  // of the block's points
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
