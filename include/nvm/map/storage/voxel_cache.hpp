// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/pool.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Remembers where recently touched voxels are: a scan falls into the same few voxels again and
/// again. Direct-mapped.
class VoxelCache {
 public:
  struct Entry {
    IndexKey key = 0;
    std::uint32_t head = kNone;   // head chunk of the voxel
    std::uint32_t insertion = 0;  // the latest one that used the voxel
  };

  /// Starts an insertion and returns its number.
  std::uint32_t begin_insertion() noexcept {
    if (++insertion_ == 0) {
      clear();
      ++insertion_;
    }
    return insertion_;
  }

  /// Another voxel than the one looked for, or none, may be remembered in its slot.
  Entry& operator[](std::uint32_t slot) noexcept { return entries_[slot]; }
  /// The slot of a voxel: strides that spread a wall along any axis over the slots.
  static std::uint32_t slot(std::int32_t x, std::int32_t y, std::int32_t z) noexcept {
    const std::uint32_t mixed = static_cast<std::uint32_t>(x) +
                                static_cast<std::uint32_t>(y) * 37U +
                                static_cast<std::uint32_t>(z) * 613U;
    return mixed % kSlots;
  }
  void forget(const VoxelIndex& voxel) noexcept {
    entries_[slot(voxel.x(), voxel.y(), voxel.z())] = {};
  }
  void clear() noexcept { entries_.fill({}); }

 private:
  static constexpr std::uint32_t kSlots = 1024;

  std::array<Entry, kSlots> entries_{};
  std::uint32_t insertion_ = 0;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
