// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/lattice.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Remembers which cells of a cubic grid hold a point: thins a scan to one point per cell. A flat
/// hash table that keeps its memory when cleared.
class VoxelSet {
 public:
  /// What became of an insertion.
  enum class Insertion : std::uint8_t { kNewCell, kOccupied, kNonFinite, kOutOfRange };

  /// `cell_size` [m], positive.
  template <class = void>
  explicit VoxelSet(double cell_size) : lattice_(cell_size), keys_(kSmallest, kFree) {}

  /// Occupies the cell of `position` [m], floor(position / cell_size) per axis. O(1).
  template <class = void>
  Insertion insert(const Eigen::Vector3d& position) {
    detail::LatticePoint point;
    switch (lattice_.locate(position, point)) {
      case detail::LatticeStatus::kNonFinite:
        return Insertion::kNonFinite;
      case detail::LatticeStatus::kOutOfRange:
        return Insertion::kOutOfRange;
      case detail::LatticeStatus::kInside:
        break;
    }
    const std::uint64_t key = pack(point.voxel);
    std::uint64_t& slot = find(key);
    if (slot == key) {
      return Insertion::kOccupied;
    }
    slot = key;
    if (++size_ * 2 > keys_.size()) {
      grow();
    }
    return Insertion::kNewCell;
  }

  /// Cells that hold a point.
  std::size_t size() const { return size_; }

  template <class = void>
  void clear() {
    std::fill(keys_.begin(), keys_.end(), kFree);
    size_ = 0;
  }

 private:
  static constexpr std::uint64_t kFree = 0;
  static constexpr std::size_t kSmallest = 1024;  // a power of two, as every size

  // Three 21-bit indices, and a high bit that tells every key from a free slot.
  static std::uint64_t pack(const detail::VoxelIndex& voxel) {
    const auto bits = [&](int axis) {
      return static_cast<std::uint64_t>(voxel[axis] + detail::kMaxVoxelIndex);
    };
    return (std::uint64_t{1} << 63) | bits(0) << 42 | bits(1) << 21 | bits(2);
  }

  // The slot that holds `key`, or the free one where it belongs. Fibonacci hashing spreads
  // neighbouring cells over the high bits.
  std::uint64_t& find(std::uint64_t key) {
    const std::size_t mask = keys_.size() - 1;
    std::size_t i = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32) & mask;
    while (keys_[i] != kFree && keys_[i] != key) {
      i = (i + 1) & mask;
    }
    return keys_[i];
  }

  template <class = void>
  void grow() {
    std::vector<std::uint64_t> old(keys_.size() * 2, kFree);
    old.swap(keys_);
    for (const std::uint64_t key : old) {
      if (key != kFree) {
        find(key) = key;
      }
    }
  }

  detail::Lattice lattice_;
  std::vector<std::uint64_t> keys_;
  std::size_t size_ = 0;
};

}  // namespace NVM_TARGET
}  // namespace nvm
