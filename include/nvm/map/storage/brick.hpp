// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/pool.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

// 4 x 4 x 4 voxels form a brick: the unit of the hash table. A 64-bit mask says which of its voxels
// exist and links lead to the bricks around it, so that the 27 voxels around a point cost 1 to 8
// bricks instead of 27 look-ups, and empty ones nothing.
inline constexpr int kBrickBits = 2;
inline constexpr int kBrickEdge = 1 << kBrickBits;
inline constexpr int kBrickCells = kBrickEdge * kBrickEdge * kBrickEdge;
inline constexpr int kBricksAround = 27;  // with the brick itself in the middle

/// The key of a brick or of a voxel: its three signed 21-bit indices and a mark, so that no key is
/// 0.
using IndexKey = std::uint64_t;

inline VoxelIndex brick_index(const VoxelIndex& voxel) {
  return {voxel.x() >> kBrickBits, voxel.y() >> kBrickBits, voxel.z() >> kBrickBits};
}

inline IndexKey index_key(std::int32_t x, std::int32_t y, std::int32_t z) {
  constexpr std::uint64_t kMask = (1U << 21) - 1;
  const auto field = [](std::int32_t i) { return static_cast<std::uint32_t>(i) & kMask; };
  return field(x) | field(y) << 21 | field(z) << 42 | std::uint64_t{1} << 63;
}
inline IndexKey index_key(const VoxelIndex& index) {
  return index_key(index.x(), index.y(), index.z());
}

inline VoxelIndex index_of_key(IndexKey key) {
  const auto field = [key](int shift) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(key >> shift) << 11) >> 11;
  };
  return {field(0), field(21), field(42)};
}

/// The place of a voxel inside its brick, 0 to 63: x fastest.
inline int cell_in_brick(const VoxelIndex& voxel) {
  constexpr int kMask = kBrickEdge - 1;
  return (voxel.x() & kMask) | (voxel.y() & kMask) << kBrickBits |
         (voxel.z() & kMask) << 2 * kBrickBits;
}

inline VoxelIndex voxel_index(IndexKey brick_key, int cell) {
  constexpr int kMask = kBrickEdge - 1;
  const VoxelIndex brick = index_of_key(brick_key);
  return {
      brick.x() * kBrickEdge + (cell & kMask),
      brick.y() * kBrickEdge + ((cell >> kBrickBits) & kMask),
      brick.z() * kBrickEdge + (cell >> 2 * kBrickBits)};
}

/// The index of the brick in a slot of Brick::around, of which x runs fastest.
inline VoxelIndex index_around(const VoxelIndex& brick, int slot) {
  return {brick.x() + slot % 3 - 1, brick.y() + slot / 3 % 3 - 1, brick.z() + slot / 9 - 1};
}

struct alignas(64) Brick {
  std::uint64_t occupied;  // bit c: cell c holds a voxel
  IndexKey key;            // 0: not in use
  std::array<std::uint32_t, kBricksAround>
      around;  // bricks, or kNone; the middle is the brick itself
  std::array<std::uint32_t, kBrickCells>
      head;  // of occupied cells: head chunk of the front surface

  bool has(int cell) const { return (occupied >> cell & 1U) != 0; }
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
