// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/image_file.hpp"
#include "nvm/map/storage/pool.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Collects what VoxelStorage::visit_state() shows.
struct StateWriter {
  struct Part {
    const void* data;
    std::size_t bytes;
  };

  template <class Number>
  void number(const Number& value, std::size_t /*max*/) {
    numbers.push_back(static_cast<std::uint64_t>(value));
  }
  template <class = void>
  void index(const std::uint32_t& value, std::size_t /*end*/) {
    numbers.push_back(value);
  }
  void check(bool /*holds*/) const {}
  template <class Pointer>
  void array(const Pointer& array, std::size_t used, std::size_t /*capacity*/) {
    arrays.push_back({array.get(), used * sizeof(array[0])});
  }

  std::vector<std::uint64_t> numbers;
  std::vector<Part> arrays;
};

/// Gives it back from an image, whose arrays are mapped. Throws std::runtime_error for numbers that
/// no map has.
class StateReader {
 public:
  /// The arrays begin at `offset`; `checksum` is of all before.
  StateReader(
      const ImageFile& file,
      std::vector<std::uint64_t> numbers,
      std::size_t offset,
      const PageChecksum& checksum)
      : file_(file), numbers_(std::move(numbers)), offset_(offset), checksum_(checksum) {}

  template <class Number>
  void number(Number& value, std::size_t max) {
    const std::uint64_t read = next();
    check(read <= max);
    value = static_cast<Number>(read);
  }
  void index(std::uint32_t& value, std::size_t end) {
    const std::uint64_t read = next();
    check(read < end || read == kNone);
    value = static_cast<std::uint32_t>(read);
  }
  void check(bool holds) const {
    if (!holds) {
      throw std::runtime_error("is corrupt: its numbers contradict one another");
    }
  }

  template <class T, class Allocator>
  void array(Array<T, Allocator>& array, std::size_t used, std::size_t capacity) {
    const std::size_t bytes = used * sizeof(T);
    const std::size_t reserved = whole_pages(capacity * sizeof(T));
    if (offset_ + whole_pages(bytes) > file_.size()) {
      throw std::runtime_error("is truncated");  // its pages would not be there
    }
    if (void* memory = file_.map(offset_, bytes, reserved)) {
      array = Array<T, Allocator>(memory, &ImageFile::unmap, reserved);
      checksum_.add(memory, whole_pages(bytes));
    } else if (used > 0) {
      read(array, used, capacity);
    }
    offset_ += whole_pages(bytes);
  }

  /// Of all until now.
  const PageChecksum& checksum() const { return checksum_; }
  /// Whether all numbers have been given, and the arrays end where the file does.
  bool is_done() const { return at_ == numbers_.size() && offset_ == file_.size(); }

 private:
  std::uint64_t next() {
    check(at_ < numbers_.size());
    return numbers_[at_++];
  }

  /// Where nothing can be mapped.
  template <class T, class Allocator>
  void read(Array<T, Allocator>& array, std::size_t used, std::size_t capacity) {
    std::vector<unsigned char> pages(whole_pages(used * sizeof(T)));
    file_.read(offset_, pages.data(), pages.size());
    checksum_.add(pages.data(), pages.size());
    array = Allocator::template allocate<T>(capacity);
    std::memcpy(static_cast<void*>(array.get()), pages.data(), used * sizeof(T));
  }

  const ImageFile& file_;
  std::vector<std::uint64_t> numbers_;
  std::size_t at_ = 0;
  std::size_t offset_;
  PageChecksum checksum_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
