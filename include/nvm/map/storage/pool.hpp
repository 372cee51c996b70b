// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "nvm/core/assert.hpp"
#include "nvm/core/target.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// "No element", "no chunk", "no voxel".
inline constexpr std::uint32_t kNone = 0xffffffffU;

inline constexpr std::size_t kArrayAlignment = 64;

struct ArrayDeleter {
  void operator()(void* memory) const noexcept {
    ::operator delete (memory, std::align_val_t{kArrayAlignment});
  }
};
/// An array whose elements are not constructed.
template <class T>
using RawArray = std::unique_ptr<T[], ArrayDeleter>;

struct FreeDeleter {
  void operator()(void* memory) const noexcept { std::free(memory); }
};
template <class T>
using ZeroedArray = std::unique_ptr<T[], FreeDeleter>;

/// Room for `count` elements that are neither constructed nor touched: the operating system commits
/// a page when it is first written, so a map costs what it holds, not what it may hold. Throws
/// std::bad_alloc.
template <class T>
RawArray<T> allocate_uninitialized(std::size_t count) {
  static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= kArrayAlignment);
  if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) {
    throw std::bad_alloc();
  }
  void* memory = ::operator new (count * sizeof(T), std::align_val_t{kArrayAlignment});
  return RawArray<T>(static_cast<T*>(memory));
}

/// `count` elements of all-zero bytes, committed when first written. Throws std::bad_alloc.
template <class T>
ZeroedArray<T> allocate_zeroed(std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  void* memory = std::calloc(count, sizeof(T));
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return ZeroedArray<T>(static_cast<T*>(memory));
}

/// Hands out and takes back the indices 0 to capacity - 1, the most recently returned first, so
/// that memory in use stays compact. The free list lives in a `std::uint32_t` of the owner's choice
/// inside each free element.
class IndexAllocator {
 public:
  IndexAllocator() = default;
  explicit IndexAllocator(std::size_t capacity) : capacity_(static_cast<std::uint32_t>(capacity)) {}

  /// A free index, or kNone when all are taken. `link(i)` is the free-list field of element i.
  template <class Link>
  std::uint32_t take(Link&& link) noexcept {
    if (free_ != kNone) {
      const std::uint32_t index = free_;
      free_ = link(index);
      ++taken_;
      return index;
    }
    if (used_ == capacity_) {
      return kNone;
    }
    ++taken_;
    return used_++;
  }

  template <class Link>
  void give_back(std::uint32_t index, Link&& link) noexcept {
    NVM_ASSERT(index < used_ && taken_ > 0);
    link(index) = free_;
    free_ = index;
    --taken_;
  }

  void clear() noexcept {
    used_ = 0;
    taken_ = 0;
    free_ = kNone;
  }

  std::size_t left() const noexcept { return capacity_ - taken_; }
  bool exhausted() const noexcept { return free_ == kNone && used_ == capacity_; }
  /// Every index handed out so far is below this.
  std::uint32_t high_water() const noexcept { return used_; }
  std::uint32_t taken() const noexcept { return taken_; }

 private:
  std::uint32_t capacity_ = 0;
  std::uint32_t used_ = 0;
  std::uint32_t taken_ = 0;
  std::uint32_t free_ = kNone;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
