// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/voxel_storage.hpp"

namespace nvm::detail {

/// What a caller's queries have in common: they come close to one another and their neighbours lie
/// at similar distances. Only speed depends on it, never an answer; one per thread, for any maps.
class VoxelQueryContext {
 public:
  /// The brick with `key`, or kNone: the same as last time more often than not.
  std::uint32_t find_brick(const VoxelStorage& storage, IndexKey key) noexcept {
    if (!storage.is_brick(brick_, key)) {
      brick_ = storage.find_brick(key);
      storage.prefetch_brick(brick_);
    }
    return brick_;
  }

  /// A squared distance that probably holds `wanted` neighbours, at most `limit`: a query that
  /// looks no farther skips most of the 27 voxels, and one that finds too few looks again without
  /// it.
  std::int32_t guess(int wanted, std::int32_t limit) const noexcept {
    if (wanted != wanted_) {
      return limit;
    }
    // The fewer neighbours, the more the distance of the last one varies from query to query.
    const float margin = wanted <= 2 ? 4.0F : wanted <= 8 ? 1.7F : 1.5F;
    const float guess = margin * mean_sq_distance_ + kSlack;
    return guess < static_cast<float>(limit) ? static_cast<std::int32_t>(guess) : limit;
  }

  /// Learns the squared distance of the last of `wanted` neighbours.
  void learn(int wanted, std::int32_t sq_distance) noexcept {
    const auto latest = static_cast<float>(sq_distance);
    mean_sq_distance_ =
        wanted == wanted_ ? kMemory * mean_sq_distance_ + (1.0F - kMemory) * latest : latest;
    wanted_ = wanted;
  }

 private:
  static constexpr float kMemory = 0.85F;
  static constexpr float kSlack =
      2000.0F;  // 45 lattice steps, so that a mean of zero gets anywhere

  std::uint32_t brick_ = kNone;
  int wanted_ = 0;
  float mean_sq_distance_ = 0.0F;
};

}  // namespace nvm::detail
