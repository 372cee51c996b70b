// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/pool.hpp"

namespace nvm::detail {

/// Remembers where recently touched voxels are: a scan falls into the same few voxels again and
/// again. Direct-mapped.
class VoxelCache {
 public:
  /// Head chunk of the voxel, or kNone when it is not remembered.
  std::uint32_t find(IndexKey key, const VoxelIndex& voxel) const noexcept {
    const Entry& entry = entries_[slot(voxel)];
    return entry.key == key ? entry.head : kNone;
  }
  void remember(IndexKey key, const VoxelIndex& voxel, std::uint32_t head) noexcept {
    entries_[slot(voxel)] = {key, head};
  }
  void forget(const VoxelIndex& voxel) noexcept { entries_[slot(voxel)] = {}; }
  void clear() noexcept { entries_.fill({}); }

 private:
  struct Entry {
    IndexKey key = 0;
    std::uint32_t head = kNone;
  };
  static constexpr std::uint32_t kSlots = 1024;

  // Strides that spread a wall along any axis over the slots.
  static std::size_t slot(const VoxelIndex& voxel) noexcept {
    const std::uint32_t mixed = static_cast<std::uint32_t>(voxel.x()) +
                                static_cast<std::uint32_t>(voxel.y()) * 37U +
                                static_cast<std::uint32_t>(voxel.z()) * 613U;
    return mixed % kSlots;
  }

  std::array<Entry, kSlots> entries_{};
};

}  // namespace nvm::detail
