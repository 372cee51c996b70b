// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
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

/// Owns elements, and gives their memory back to `Allocator` or to whoever else it came from
/// (map_image.hpp). One std::unique_ptr costs as much to include as all of these.
template <class T, class Allocator>
class Array {
 public:
  using Release = void (*)(void* memory, std::size_t bytes) noexcept;

  Array(std::nullptr_t /*none*/ = nullptr) noexcept {}
  explicit Array(void* memory, Release release = nullptr, std::size_t bytes = 0) noexcept
      : elements_(static_cast<T*>(memory)), release_(release), bytes_(bytes) {}

  Array(Array&& other) noexcept
      : elements_(other.elements_), release_(other.release_), bytes_(other.bytes_) {
    other.elements_ = nullptr;
  }
  Array& operator=(Array&& other) noexcept {
    std::swap(elements_, other.elements_);
    std::swap(release_, other.release_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Array() {
    if (elements_ != nullptr) {
      release_ == nullptr ? Allocator::release(elements_) : release_(elements_, bytes_);
    }
  }

  T* get() const noexcept { return elements_; }
  T& operator[](std::size_t i) const noexcept { return elements_[i]; }
  bool operator==(std::nullptr_t) const noexcept { return elements_ == nullptr; }
  bool operator!=(std::nullptr_t) const noexcept { return elements_ != nullptr; }

 private:
  T* elements_ = nullptr;
  Release release_ = nullptr;
  std::size_t bytes_ = 0;
};

/// Elements that are neither constructed nor touched: the operating system commits a page when it
/// is first written, so a map costs what it holds, not what it may hold.
struct AlignedNew {
  /// Throws std::bad_alloc.
  template <class T>
  static Array<T, AlignedNew> allocate(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= kArrayAlignment);
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) {
      throw std::bad_alloc();
    }
    void* memory = ::operator new (count * sizeof(T), std::align_val_t{kArrayAlignment});
    return Array<T, AlignedNew>(memory);
  }
  static void release(void* memory) noexcept {
    ::operator delete (memory, std::align_val_t{kArrayAlignment});
  }
};
template <class T>
using RawArray = Array<T, AlignedNew>;

/// Elements of all-zero bytes, committed when first written.
struct ZeroedMalloc {
  /// Throws std::bad_alloc.
  template <class T>
  static Array<T, ZeroedMalloc> allocate(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    void* memory = std::calloc(count, sizeof(T));
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    return Array<T, ZeroedMalloc>(memory);
  }
  static void release(void* memory) noexcept { std::free(memory); }
};
template <class T>
using ZeroedArray = Array<T, ZeroedMalloc>;

template <class T>
RawArray<T> allocate_uninitialized(std::size_t count) {
  return AlignedNew::allocate<T>(count);
}
template <class T>
ZeroedArray<T> allocate_zeroed(std::size_t count) {
  return ZeroedMalloc::allocate<T>(count);
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

  std::size_t capacity() const noexcept { return capacity_; }
  std::size_t left() const noexcept { return capacity_ - taken_; }
  bool exhausted() const noexcept { return free_ == kNone && used_ == capacity_; }
  /// Every index handed out so far is below this.
  std::uint32_t high_water() const noexcept { return used_; }
  std::uint32_t taken() const noexcept { return taken_; }

  /// Shows all that an image of the map must hold, for reading or writing (map_image.hpp).
  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor& visitor) {
    visitor.number(self.used_, self.capacity_);
    visitor.number(self.taken_, self.used_);
    visitor.index(self.free_, self.used_);
  }

 private:
  std::uint32_t capacity_ = 0;
  std::uint32_t used_ = 0;
  std::uint32_t taken_ = 0;
  std::uint32_t free_ = kNone;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
