// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nvm/core/assert.hpp"
#include "nvm/core/target.hpp"
#include "nvm/map/storage/pool.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// The order in which voxels were last used, for exact least-recently-used eviction (spec §3.5).
///
/// Time is counted in epochs. A use only stores the current epoch in the voxel's stamp, with a
/// relaxed atomic, so queries may do it from many threads. Voxels stand in one list per epoch, in
/// the list of their last *known* use; only when an eviction meets a voxel whose stamp is newer
/// than its list, it moves the voxel to the list of its stamp. Each use causes at most one move:
/// eviction is O(1) amortised, and exact between epochs. Voxels of one epoch leave in the order in
/// which they joined its list.
///
/// The lists' ends are kept in a ring of epochs. When the oldest voxel is more epochs old than the
/// ring is long, the epochs are renumbered without gaps: at most once in `capacity` epochs.
class Recency {
 public:
  Recency() = default;
  explicit Recency(std::size_t capacity)
      : nodes_(allocate_uninitialized<Node>(capacity)),
        ring_mask_(static_cast<std::uint32_t>(ring_size(capacity) - 1)),
        ring_(allocate_zeroed<List>(ring_mask_ + std::size_t{1})) {}

  static std::size_t bytes(std::size_t capacity) {
    return capacity * sizeof(Node) + ring_size(capacity) * sizeof(List);
  }

  /// What is in use when `voxels` of them have ever been.
  std::size_t used_bytes(std::size_t voxels) const noexcept {
    return voxels * sizeof(Node) + std::min<std::size_t>(epoch_, ring_mask_) * sizeof(List);
  }

  /// Later uses count as more recent than all earlier ones.
  void begin_epoch() noexcept {
    if (count_ == 0) {
      oldest_ = epoch_ = kFirstEpoch;
      return;
    }
    skip_empty_lists();
    if (epoch_ - oldest_ >= ring_mask_ || epoch_ == kLastEpoch) {
      renumber();
    }
    ++epoch_;
  }

  /// Marks `id` as used now. Safe from many threads at once while nobody calls a non-const member.
  void use(std::uint32_t id) const noexcept {
    std::atomic<std::uint32_t>& stamp = nodes_[id].stamp;
    if (stamp.load(std::memory_order_relaxed) != epoch_) {
      stamp.store(epoch_, std::memory_order_relaxed);
    }
  }

  /// Starts to load what use(id) changes.
  [[gnu::always_inline]] void prefetch(std::uint32_t id) const noexcept {
    __builtin_prefetch(&nodes_[id]);
  }

  /// Adds `id`, used now.
  void add(std::uint32_t id) noexcept {
    new (&nodes_[id]) Node{epoch_, epoch_, kNone, kNone};
    append(id);
    ++count_;
  }

  void remove(std::uint32_t id) noexcept {
    unlink(id);
    --count_;
  }

  /// The least recently used voxel. There must be one.
  std::uint32_t oldest() noexcept {
    NVM_ASSERT(count_ > 0);
    for (;;) {
      skip_empty_lists();
      const std::uint32_t id = list(oldest_).first();
      if (stamp(id) == oldest_) {
        return id;
      }
      move_to_stamp(id);
    }
  }

  std::uint32_t epoch() const noexcept { return epoch_; }  ///< of a use now

  /// Where a voxel stands, and when it was last used.
  struct Standing {
    std::uint32_t id;
    std::uint32_t listed;
    std::uint32_t stamp;
  };

  /// All voxels, from the oldest list to the newest, each list in order.
  template <class = void>
  std::vector<Standing> standings() const {
    std::vector<Standing> standings;
    standings.reserve(count_);
    for (std::uint32_t epoch = oldest_; count_ > 0 && epoch <= epoch_; ++epoch) {
      for (std::uint32_t id = list(epoch).first(); id != kNone; id = nodes_[id].next) {
        standings.push_back({id, epoch, stamp(id)});
      }
    }
    return standings;
  }

  /// Adds a voxel as standings() gave it, in the same order, to an empty order or one that only
  /// this has filled. False, and nothing is added, when it cannot have come from there.
  bool restore(const Standing& standing) noexcept {
    const std::uint32_t oldest = count_ == 0 ? standing.listed : std::min(oldest_, standing.listed);
    const std::uint32_t newest = count_ == 0 ? standing.stamp : std::max(epoch_, standing.stamp);
    const bool possible = standing.listed >= kFirstEpoch && standing.listed <= standing.stamp &&
                          newest <= kLastEpoch && newest - oldest <= ring_mask_;
    if (possible) {
      new (&nodes_[standing.id]) Node{standing.stamp, standing.listed, kNone, kNone};
      append(standing.id);
      oldest_ = oldest;
      epoch_ = newest;
      ++count_;
    }
    return possible;
  }
  /// After the last voxel: what epoch() was. False, and nothing changes, when that is impossible.
  bool restore_epoch(std::uint32_t epoch) noexcept {
    const std::uint32_t oldest = count_ == 0 ? epoch : oldest_;
    const bool possible = epoch >= kFirstEpoch && epoch <= kLastEpoch &&
                          (count_ == 0 || epoch >= epoch_) && epoch - oldest <= ring_mask_;
    if (possible) {
      oldest_ = oldest;
      epoch_ = epoch;
    }
    return possible;
  }

  /// For images (map_image.hpp): `used` of `capacity` voxels have ever been.
  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor& visitor, std::uint32_t used, std::size_t capacity) {
    visitor.number(self.count_, used);
    visitor.number(self.epoch_, kLastEpoch);
    visitor.number(self.oldest_, self.epoch_);
    visitor.check(self.epoch_ - self.oldest_ <= self.ring_mask_);
    visitor.array(self.nodes_, used, capacity);
    for (std::uint32_t epoch = self.oldest_; epoch <= self.epoch_; ++epoch) {
      visitor.number(self.list(epoch).first_plus_one, used);
      visitor.number(self.list(epoch).last_plus_one, used);
    }
  }

  /// The epoch of the last use, for comparing two voxels.
  std::uint32_t stamp(std::uint32_t id) const noexcept {
    return nodes_[id].stamp.load(std::memory_order_relaxed);
  }

  void clear() noexcept {
    for (std::uint32_t epoch = oldest_; count_ > 0 && epoch <= epoch_; ++epoch) {
      list(epoch) = List{};
    }
    oldest_ = epoch_ = kFirstEpoch;
    count_ = 0;
  }

 private:
  static constexpr std::uint32_t kFirstEpoch = 1;
  static constexpr std::uint32_t kLastEpoch = 0xfffffff0U;

  struct Node {
    mutable std::atomic<std::uint32_t> stamp;  // epoch of the last use
    std::uint32_t listed;                      // the list that it stands in; never newer than stamp
    std::uint32_t previous;
    std::uint32_t next;
  };

  // Ends of a list, plus one, so that zeroed memory is an empty list.
  struct List {
    std::uint32_t first_plus_one = 0;
    std::uint32_t last_plus_one = 0;
    std::uint32_t first() const noexcept { return first_plus_one - 1; }
    std::uint32_t last() const noexcept { return last_plus_one - 1; }
    bool empty() const noexcept { return first_plus_one == 0; }
  };

  static std::size_t ring_size(std::size_t capacity) {
    std::size_t size = 1024;
    while (size <
           2 * capacity + 2) {  // each voxel may have its list's and its stamp's epoch to itself
      size *= 2;
    }
    return size;
  }

  List& list(std::uint32_t epoch) noexcept { return ring_[epoch & ring_mask_]; }
  const List& list(std::uint32_t epoch) const noexcept { return ring_[epoch & ring_mask_]; }

  void skip_empty_lists() noexcept {
    while (oldest_ < epoch_ && list(oldest_).empty()) {
      ++oldest_;
    }
  }

  void append(std::uint32_t id) noexcept {
    List& target = list(nodes_[id].listed);
    nodes_[id].previous = target.last();
    nodes_[id].next = kNone;
    if (target.empty()) {
      target.first_plus_one = id + 1;
    } else {
      nodes_[target.last()].next = id;
    }
    target.last_plus_one = id + 1;
  }

  void unlink(std::uint32_t id) noexcept {
    const Node& node = nodes_[id];
    List& source = list(node.listed);
    if (node.previous == kNone) {
      source.first_plus_one = node.next + 1;
    } else {
      nodes_[node.previous].next = node.next;
    }
    if (node.next == kNone) {
      source.last_plus_one = node.previous + 1;
    } else {
      nodes_[node.next].previous = node.previous;
    }
  }

  void move_to_stamp(std::uint32_t id) noexcept {
    unlink(id);
    nodes_[id].listed = stamp(id);
    append(id);
  }

  /// Brings every voxel into the list of its stamp.
  void settle() noexcept {
    for (std::uint32_t epoch = oldest_; count_ > 0 && epoch < epoch_; ++epoch) {
      for (std::uint32_t id = list(epoch).first(); id != kNone;) {
        const std::uint32_t next = nodes_[id].next;
        if (stamp(id) != epoch) {
          move_to_stamp(id);
        }
        id = next;
      }
    }
  }

  /// Closes the gaps between the epochs in use: the i-th non-empty list becomes epoch i.
  void renumber() noexcept {
    settle();
    std::uint32_t next_epoch = kFirstEpoch;
    // Chained into one list in order, then dealt out again: old and new epochs share the ring.
    List all;
    for (std::uint32_t epoch = oldest_; epoch <= epoch_; ++epoch) {
      List& source = list(epoch);
      if (source.empty()) {
        continue;
      }
      for (std::uint32_t id = source.first(); id != kNone; id = nodes_[id].next) {
        nodes_[id].listed = next_epoch;
        nodes_[id].stamp.store(next_epoch, std::memory_order_relaxed);
      }
      if (all.empty()) {
        all.first_plus_one = source.first_plus_one;
      } else {
        nodes_[all.last()].next = source.first();
      }
      all.last_plus_one = source.last_plus_one;
      source = List{};
      ++next_epoch;
    }
    for (std::uint32_t id = all.first(); id != kNone;) {
      const std::uint32_t next = nodes_[id].next;
      append(id);
      id = next;
    }
    oldest_ = kFirstEpoch;
    epoch_ = next_epoch;
  }

  RawArray<Node> nodes_;
  std::uint32_t ring_mask_ = 0;
  ZeroedArray<List> ring_;
  std::uint32_t oldest_ = kFirstEpoch;  // no voxel stands in an older list
  std::uint32_t epoch_ = kFirstEpoch;
  std::uint32_t count_ = 0;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
