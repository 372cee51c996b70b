// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {

/// What a caller's queries have in common: they come close to one another and their neighbours lie
/// at similar distances. Only speed depends on it, never an answer; one per thread, for any maps.
class VoxelQueryContext {
 public:
  /// Comes to a brick, which is one of the latest more often than not.
  NVM_SHARED void enter(const VoxelStorage& storage, const VoxelIndex& index) noexcept {
    const IndexKey key = index_key(index);
    std::uint32_t& remembered = bricks_[slot(index)];
    is_new_place_ = !storage.is_brick(remembered, key);
    if (is_new_place_) {
      remembered = storage.find_brick(key);
      storage.prefetch_brick(remembered);
    }
    brick_ = remembered;
  }
  /// The brick, or kNone.
  NVM_SHARED std::uint32_t brick() const noexcept { return brick_; }
  NVM_SHARED bool is_new_place() const noexcept { return is_new_place_; }

  /// A squared distance that probably holds `wanted` neighbours, at most `limit`: a query that
  /// looks no farther skips most of the 27 voxels, and one that finds too few looks again without
  /// it.
  NVM_SHARED std::int32_t guess(int wanted, std::int32_t limit) const noexcept {
    if (wanted != wanted_) {
      return limit;
    }
    // The fewer neighbours, the more the distance of the last one varies from query to query.
    const float margin = wanted <= 2 ? 4.0F : wanted <= 8 ? 1.7F : 1.5F;
    const float guess = margin * mean_sq_distance_ + kSlack;
    return guess < static_cast<float>(limit) ? static_cast<std::int32_t>(guess) : limit;
  }

  /// Learns the squared distance of the last of `wanted` neighbours.
  NVM_SHARED void learn(int wanted, std::int32_t sq_distance) noexcept {
    const auto latest = static_cast<float>(sq_distance);
    mean_sq_distance_ =
        wanted == wanted_ ? kMemory * mean_sq_distance_ + (1.0F - kMemory) * latest : latest;
    wanted_ = wanted;
  }

 private:
  static constexpr float kMemory = 0.85F;
  static constexpr float kSlack =
      2000.0F;  // 45 lattice steps, so that a mean of zero gets anywhere

  static constexpr std::uint32_t kSlots = 64;

  /// Strides that spread what a scan's rings see over the slots.
  NVM_SHARED static std::uint32_t slot(const VoxelIndex& brick) noexcept {
    const std::uint32_t mixed = static_cast<std::uint32_t>(brick.x()) +
                                static_cast<std::uint32_t>(brick.y()) * 5U +
                                static_cast<std::uint32_t>(brick.z()) * 29U;
    return mixed % kSlots;
  }

  std::array<std::uint32_t, kSlots> bricks_{};  // any are allowed: each is checked
  std::uint32_t brick_ = kNone;
  bool is_new_place_ = true;
  int wanted_ = 0;
  float mean_sq_distance_ = 0.0F;
};

}  // namespace nvm::detail
