// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/pool.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// The key of a brick with its hash, for callers that look more than once.
struct BrickAddress {
  BrickAddress() = default;
  BrickAddress(IndexKey brick) noexcept : key(brick), hash(hash_of(brick)) {}

  IndexKey key;
  std::uint64_t hash;

 private:
  /// The full finaliser of MurmurHash3: the keys of neighbouring bricks differ in few bits.
  static std::uint64_t hash_of(IndexKey key) noexcept {
    key ^= key >> 33;
    key *= 0xff51afd7ed558ccdULL;
    key ^= key >> 33;
    key *= 0xc4ceb9fe1a85ec53ULL;
    key ^= key >> 33;
    return key;
  }
};

/// A flat hash table from a brick's address to the brick, with linear probing and backward-shift
/// deletion.
///
/// A slot is chosen by the highest bits of the hash, so doubling the table spreads its entries
/// without changing their order: one sequential pass.
class BrickTableShard {
 public:
  /// The brick at `address`, or kNone.
  std::uint32_t find(const BrickAddress& address) const noexcept {
    if (slots_ == nullptr) {
      return kNone;
    }
    for (std::size_t i = home(address.hash);; i = next(i)) {
      if (slots_[i].key == address.key) {
        return slots_[i].brick;
      }
      if (slots_[i].key == 0) {
        return kNone;
      }
    }
  }

  /// Starts to load what find() reads.
  [[gnu::always_inline]] void prefetch(const BrickAddress& address) const noexcept {
    if (slots_ != nullptr) {
      __builtin_prefetch(&slots_[home(address.hash)]);
    }
  }

  /// `address` must not be in the table. Throws std::bad_alloc, before anything is changed, when
  /// the table cannot grow.
  void insert(const BrickAddress& address, std::uint32_t brick) {
    if (slots_ == nullptr) {
      slots_ = allocate_zeroed<Slot>(slot_count());
    } else if (2 * (size_ + 1) > slot_count()) {
      grow();
    }
    place({address.key, brick}, address.hash);
    ++size_;
  }

  /// `address` must be in the table.
  void erase(const BrickAddress& address) noexcept {
    std::size_t hole = home(address.hash);
    while (slots_[hole].key != address.key) {
      hole = next(hole);
    }
    for (std::size_t i = next(hole); slots_[i].key != 0; i = next(i)) {
      // Whether its probe passes over the hole.
      if (distance(home(BrickAddress(slots_[i].key).hash), i) >= distance(hole, i)) {
        slots_[hole] = slots_[i];
        hole = i;
      }
    }
    slots_[hole].key = 0;
    --size_;
  }

  std::size_t bytes() const noexcept { return slots_ == nullptr ? 0 : slot_count() * sizeof(Slot); }

  struct Slot {
    IndexKey key;
    std::uint32_t brick;
  };

  /// Shows all that an image of the map must hold, for reading or writing (map_image.hpp).
  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor& visitor) {
    visitor.number(self.shift_, 64 - kFirstBits);
    visitor.check(self.shift_ >= 64 - kMostBits);
    visitor.number(self.size_, self.slot_count() / 2);
    std::uint32_t tables = self.slots_ == nullptr ? 0 : 1;
    visitor.number(tables, 1);
    visitor.check(tables == 1 || self.size_ == 0);
    if (tables == 1) {
      visitor.array(self.slots_, self.slot_count(), self.slot_count());
    }
  }

  static constexpr int kFirstBits = 4;
  static constexpr int kMostBits = 34;  // twice the bricks that 32 bits count

 private:
  std::size_t slot_count() const noexcept { return std::size_t{1} << (64 - shift_); }
  std::size_t home(std::uint64_t hash) const noexcept {
    return static_cast<std::size_t>(hash >> shift_);
  }
  std::size_t next(std::size_t slot) const noexcept { return (slot + 1) & (slot_count() - 1); }
  std::size_t distance(std::size_t from, std::size_t to) const noexcept {
    return (to - from) & (slot_count() - 1);
  }

  void place(const Slot& slot, std::uint64_t hash) noexcept {
    std::size_t i = home(hash);
    while (slots_[i].key != 0) {
      i = next(i);
    }
    slots_[i] = slot;
  }

  void grow() {
    const std::size_t old_count = slot_count();
    ZeroedArray<Slot> old = allocate_zeroed<Slot>(2 * old_count);
    std::swap(old, slots_);
    --shift_;
    for (std::size_t i = 0; i < old_count; ++i) {
      if (old[i].key != 0) {
        place(old[i], BrickAddress(old[i].key).hash);
      }
    }
  }

  int shift_ = 64 - kFirstBits;
  std::size_t size_ = 0;
  ZeroedArray<Slot> slots_;  // null until the first insertion
};

/// Finds bricks by their address. In shards that grow one by one, each at its own time, because
/// doubling one large table is a pause: 10 ms at 10^7 points.
class BrickTable {
 public:
  /// The brick at `address`, or kNone.
  std::uint32_t find(const BrickAddress& address) const noexcept {
    return shards_[shard(address)].find(address);
  }

  /// Starts to load what find() reads.
  [[gnu::always_inline]] void prefetch(const BrickAddress& address) const noexcept {
    shards_[shard(address)].prefetch(address);
  }

  /// `address` must not be in the table. Throws std::bad_alloc, before anything is changed, when
  /// the table cannot grow.
  void insert(const BrickAddress& address, std::uint32_t brick) {
    shards_[shard(address)].insert(address, brick);
  }

  /// `address` must be in the table.
  void erase(const BrickAddress& address) noexcept { shards_[shard(address)].erase(address); }

  std::size_t bytes() const noexcept {
    std::size_t sum = 0;
    for (const BrickTableShard& shard : shards_) {
      sum += shard.bytes();
    }
    return sum;
  }

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor& visitor) {
    for (auto& shard : self.shards_) {
      BrickTableShard::visit_state(shard, visitor);
    }
  }

  /// The most that a table of `bricks` bricks owns, while it grows, wherever they fall.
  static std::size_t max_bytes(std::size_t bricks) {
    return (6 * bricks + (2 * kShards << BrickTableShard::kFirstBits)) *
           sizeof(BrickTableShard::Slot);
  }

 private:
  static constexpr std::size_t kShards = 64;
  static std::size_t shard(const BrickAddress& address) noexcept { return address.hash % kShards; }

  std::array<BrickTableShard, kShards> shards_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
