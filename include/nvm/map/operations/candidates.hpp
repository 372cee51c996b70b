// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_MAP_OPERATIONS_CANDIDATES_HPP  // a kernel: nvm/core/target.hpp
#define NVM_MAP_OPERATIONS_CANDIDATES_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>

#include "nvm/core/target.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/storage/lanes.hpp"

NVM_BEGIN_DETAIL_KERNELS

/// The points that a query has found so far, in the order in which it met them, on the stack.
template <class = void>
class Candidates {
 public:
  static constexpr int kRoom = 256;

  /// For a query of the `wanted` nearest, of which there is at least one.
  explicit Candidates(int wanted) noexcept : wanted_(wanted) {}

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

  /// Writes the indices of the wanted nearest candidates, nearest first, to `order` and returns
  /// how many there are. Of equally near ones the candidate met first comes first.
  int nearest(std::uint8_t* order) noexcept {
    if (count_ > kMaxRanked) {
      keep_nearest();
    }
    const int found = std::min(count_, wanted_);
    if (!rank(order)) {
      keep_nearest();
      std::iota(order, order + found, std::uint8_t{0});
    }
    return found;
  }

  /// Drops all but the wanted nearest, and returns the distance that a later candidate must beat.
  [[gnu::noinline, gnu::cold]] std::int32_t keep_nearest() noexcept {
    std::array<std::uint64_t, kRoom> keys;  // distance, then index
    for (int i = 0; i < count_; ++i) {
      keys[static_cast<std::size_t>(i)] =
          static_cast<std::uint64_t>(sq_distances_[i]) << 32 | static_cast<std::uint32_t>(i);
    }
    const int kept = std::min(count_, wanted_);
    std::partial_sort(keys.begin(), keys.begin() + kept, keys.begin() + count_);
    std::array<PointId, kMaxRanked> ids;
    for (int i = 0; i < kept; ++i) {
      const std::uint64_t key = keys[static_cast<std::size_t>(i)];
      ids[static_cast<std::size_t>(i)] = ids_[static_cast<std::uint32_t>(key)];
      sq_distances_[i] = static_cast<std::int32_t>(key >> 32);
    }
    std::copy_n(ids.begin(), kept, ids_);
    count_ = kept;
    return kept < wanted_ ? std::numeric_limits<std::int32_t>::max() : sq_distances_[kept - 1];
  }

 private:
  static constexpr int kMaxRanked = static_cast<int>(kMaxNeighbors);

  /// order[r] = index of the candidate with r nearer ones. Counting them needs no branch that could
  /// be mispredicted, which beats a heap for the 8 to 64 candidates of a query. False when some are
  /// equally near: they would have the same rank.
  bool rank(std::uint8_t* order) noexcept {
    const IntLanes padding = IntLanes{} + std::numeric_limits<std::int32_t>::max();
    std::memcpy(&sq_distances_[count_], &padding, sizeof(padding));
    std::memcpy(&sq_distances_[count_ + kLanes], &padding, sizeof(padding));
    IntLanes sums{};
    int ranked = 0;
    for (; ranked < count_; ranked += 2 * kLanes) {
      alignas(32) std::array<std::int32_t, 2 * kLanes> ranks;
      rank_two_blocks(ranked, ranks.data(), sums);
      const int end = std::min(ranked + 2 * kLanes, count_);
      for (int i = ranked; i < end; ++i) {
        order[ranks[static_cast<std::size_t>(i - ranked)]] = static_cast<std::uint8_t>(i);
      }
    }
    // All candidates are nearer than the padding. Two of the same rank would lower the sum.
    const int distinct = count_ * (count_ - 1) / 2 + (ranked - count_) * count_;
    return sum_of(sums) == distinct;
  }

  [[gnu::always_inline]] void rank_two_blocks(
      int begin, std::int32_t* ranks, IntLanes& sums) const noexcept {
    IntLanes low;
    IntLanes high;
    std::memcpy(&low, &sq_distances_[begin], sizeof(low));
    std::memcpy(&high, &sq_distances_[begin + kLanes], sizeof(high));
    IntLanes low_ranks{};
    IntLanes high_ranks{};
    // Four at a time, which may count some padding: it is nearer than nothing.
    for (int first = 0; first < count_; first += 4) {
      for (int other = first; other < first + 4; ++other) {
        const IntLanes distance = IntLanes{} + sq_distances_[other];
        low_ranks -= low > distance;
        high_ranks -= high > distance;
      }
    }
    std::memcpy(ranks, &low_ranks, sizeof(low_ranks));
    std::memcpy(ranks + kLanes, &high_ranks, sizeof(high_ranks));
    sums += low_ranks + high_ranks;
  }

  alignas(32) std::int32_t sq_distances_[kRoom + 2 * kLanes];
  alignas(32) PointId ids_[kRoom + kLanes];
  int wanted_;
  int count_ = 0;
};

NVM_END_DETAIL_KERNELS

#endif  // NVM_MAP_OPERATIONS_CANDIDATES_HPP
