// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "nvm/map/neighbor.hpp"
#include "nvm/map/storage/lanes.hpp"

namespace nvm::detail {

/// The points that a query has found so far, in the order in which it met them, on the stack.
class Candidates {
 public:
  static constexpr int kRoom = 256;

  int count() const noexcept { return count_; }
  bool full() const noexcept { return count_ > kRoom - kLanes; }
  std::int32_t sq_distance(int index) const noexcept { return sq_distances_[index]; }
  PointId id(int index) const noexcept { return ids_[index]; }
  void clear() noexcept { count_ = 0; }

  /// Appends the lanes of `mask`; the point in lane i has the id first_id + i. Not when full().
  [[gnu::always_inline]] void append(
      std::uint32_t mask, const IntLanes& sq_distances, PointId first_id) noexcept {
    compress(mask, sq_distances, &sq_distances_[count_]);
    const IntLanes ids = IntLanes{0, 1, 2, 3, 4, 5, 6, 7} + static_cast<std::int32_t>(first_id);
    compress(mask, ids, reinterpret_cast<std::int32_t*>(&ids_[count_]));
    count_ += __builtin_popcount(mask);
  }

  /// Writes the indices of the `wanted` nearest candidates, nearest first, to `order` and returns
  /// how many there are. Of equally near ones the candidate met first comes first.
  int nearest(int wanted, std::uint8_t* order) noexcept {
    if (count_ > kMaxRanked) {
      keep_nearest(wanted);
    }
    const int ranked = count_;
    std::array<std::uint8_t, kMaxRanked> by_rank;
    rank_all(by_rank);
    const int found = std::min(ranked, wanted);
    std::memcpy(order, by_rank.data(), static_cast<std::size_t>(found));
    return found;
  }

  /// Drops all but the `wanted` nearest, and returns the distance that a later candidate must beat.
  std::int32_t keep_nearest(int wanted) noexcept {
    std::array<std::uint64_t, kRoom> keys;  // distance, then index
    for (int i = 0; i < count_; ++i) {
      keys[static_cast<std::size_t>(i)] =
          static_cast<std::uint64_t>(sq_distances_[i]) << 32 | static_cast<std::uint32_t>(i);
    }
    const int kept = std::min(count_, wanted);
    std::partial_sort(keys.begin(), keys.begin() + kept, keys.begin() + count_);
    std::array<PointId, kMaxRanked> ids;
    for (int i = 0; i < kept; ++i) {
      const std::uint64_t key = keys[static_cast<std::size_t>(i)];
      ids[static_cast<std::size_t>(i)] = ids_[static_cast<std::uint32_t>(key)];
      sq_distances_[i] = static_cast<std::int32_t>(key >> 32);
    }
    std::copy_n(ids.begin(), kept, ids_);
    count_ = kept;
    return kept < wanted ? std::numeric_limits<std::int32_t>::max() : sq_distances_[kept - 1];
  }

 private:
  static constexpr int kMaxRanked = static_cast<int>(kMaxNeighbors);

  /// by_rank[r] = index of the candidate that r others precede. Counting them needs no branch that
  /// could be mispredicted, which beats a heap for the 8 to 64 candidates of a query.
  void rank_all(std::array<std::uint8_t, kMaxRanked>& by_rank) noexcept {
    const int blocks = (count_ + kLanes - 1) / kLanes;
    for (int i = count_; i < blocks * kLanes; ++i) {
      sq_distances_[i] = std::numeric_limits<std::int32_t>::max();
    }
    for (int block = 0; block < blocks; ++block) {
      IntLanes ranks;
      rank_block(block, ranks);
      const int lanes = std::min(kLanes, count_ - block * kLanes);
      for (int lane = 0; lane < lanes; ++lane) {
        by_rank[static_cast<std::size_t>(ranks[lane])] =
            static_cast<std::uint8_t>(block * kLanes + lane);
      }
    }
  }

  [[gnu::always_inline]] void rank_block(int block, IntLanes& ranks) const noexcept {
    // A candidate met earlier precedes when it is not farther; one met later only when it is
    // nearer.
    static constexpr std::int32_t kEarlier[2 * kLanes] = {
        0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1};
    IntLanes values;
    std::memcpy(&values, &sq_distances_[block * kLanes], sizeof(values));
    ranks = IntLanes{};
    const int begin = block * kLanes;
    const int end = std::min(begin + kLanes, count_);
    for (int other = 0; other < begin; ++other) {
      ranks -= values > IntLanes{} + (sq_distances_[other] - 1);
    }
    for (int other = begin; other < end; ++other) {
      IntLanes earlier;  // -1 in the lanes behind `other`
      std::memcpy(&earlier, &kEarlier[kLanes - 1 - (other - begin)], sizeof(earlier));
      ranks -= values > earlier + sq_distances_[other];
    }
    for (int other = end; other < count_; ++other) {
      ranks -= values > IntLanes{} + sq_distances_[other];
    }
  }

  alignas(32) std::int32_t sq_distances_[kRoom + kLanes];
  alignas(32) PointId ids_[kRoom + kLanes];
  int count_ = 0;
};

}  // namespace nvm::detail
