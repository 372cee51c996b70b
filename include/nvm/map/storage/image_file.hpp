// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
#include <unistd.h>
#endif

#include "nvm/core/target.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// Parts of an image begin at multiples of this.
inline constexpr std::size_t kImagePage = 4096;

inline std::size_t whole_pages(std::size_t bytes) {
  return (bytes + kImagePage - 1) / kImagePage * kImagePage;
}

/// A checksum at the speed of memory. It finds damage, not intent.
class PageChecksum {
 public:
  /// `size` must be a multiple of 32 bytes.
  void add(const void* bytes, std::size_t size) noexcept {
    const auto* from = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < size; i += sizeof(lanes_)) {
      std::uint64_t words[4];
      std::memcpy(words, from + i, sizeof(words));
      for (int lane = 0; lane < 4; ++lane) {
        lanes_[lane] = mixed(lanes_[lane] + words[lane]);
      }
    }
  }
  std::uint64_t value() const noexcept {
    std::uint64_t sum = 0;
    for (const std::uint64_t lane : lanes_) {
      sum = mixed(sum + lane);
    }
    return sum;
  }

 private:
  // A bijection: no single word can change without changing the sum.
  static std::uint64_t mixed(std::uint64_t x) noexcept {
    x *= 0x9e3779b97f4a7c15ULL;
    return x << 29 | x >> 35;
  }

  std::uint64_t lanes_[4] = {1, 2, 3, 4};
};

/// Writes pages and sums them up.
class ImageOutput {
 public:
  explicit ImageOutput(std::FILE* file) : file_(file) {}

  /// Writes `bytes` and zeros to the end of the page.
  void write(const void* data, std::size_t bytes) noexcept {
    const std::size_t whole = bytes / kImagePage * kImagePage;
    put(data, whole);
    if (whole < bytes) {
      unsigned char last[kImagePage] = {};
      std::memcpy(last, static_cast<const unsigned char*>(data) + whole, bytes - whole);
      put(last, kImagePage);
    }
  }

  bool ok() const noexcept { return ok_; }
  const PageChecksum& checksum() const noexcept { return checksum_; }

 private:
  void put(const void* data, std::size_t bytes) noexcept {
    checksum_.add(data, bytes);
    ok_ = ok_ && std::fwrite(data, 1, bytes, file_) == bytes;
  }

  std::FILE* file_;
  PageChecksum checksum_;
  bool ok_ = true;
};

/// Owns an open file. A std::unique_ptr would bring <memory> into every file that includes nvm.
class File {
 public:
  explicit File(std::FILE* file) noexcept : file_(file) {}
  File(File&& other) noexcept : file_(other.release()) {}
  File& operator=(File&&) = delete;
  ~File() {
    if (file_ != nullptr) {
      std::fclose(file_);
    }
  }

  std::FILE* get() const noexcept { return file_; }
  std::FILE* release() noexcept {
    std::FILE* file = file_;
    file_ = nullptr;
    return file;
  }

 private:
  std::FILE* file_;
};

/// A file that is read, or mapped part by part where that can be done.
class ImageFile {
 public:
  explicit ImageFile(const std::string& path) : file_(std::fopen(path.c_str(), "rb")) {
    if (file_.get() == nullptr) {
      throw std::runtime_error("cannot be opened");
    }
  }

  /// Throws std::runtime_error at the end of the file.
  void read(std::size_t offset, void* to, std::size_t bytes) const {
    if (std::fseek(file_.get(), static_cast<long>(offset), SEEK_SET) != 0 ||
        std::fread(to, 1, bytes, file_.get()) != bytes) {
      throw std::runtime_error("is truncated");
    }
  }
  /// All of it, also where it has no size, as a pipe.
  template <class = void>
  std::vector<std::uint8_t> contents() const {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    std::vector<std::uint8_t> bytes;
    std::rewind(file_.get());
    std::size_t size = 0;
    do {
      bytes.resize(size + kBlock);
      size += std::fread(&bytes[size], 1, kBlock, file_.get());
    } while (size == bytes.size());
    bytes.resize(size);
    if (std::ferror(file_.get()) != 0) {
      throw std::runtime_error("cannot be read");
    }
    return bytes;
  }
  std::size_t size() const {
    const bool is_at_end = std::fseek(file_.get(), 0, SEEK_END) == 0;
    const long size = is_at_end ? std::ftell(file_.get()) : -1;
    return size < 0 ? 0 : static_cast<std::size_t>(size);
  }

  /// Memory of `reserved` bytes that begins with `used` bytes of the file. What is written to it
  /// stays there. Null where that is impossible.
  void* map(std::size_t offset, std::size_t used, std::size_t reserved) const noexcept {
#if defined(__unix__) || defined(__APPLE__)
    if (used == 0 || offset % static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) != 0) {
      return nullptr;
    }
    constexpr int kAccess = PROT_READ | PROT_WRITE;
#ifdef MAP_NORESERVE
    constexpr int kRoom = MAP_PRIVATE | MAP_ANON | MAP_NORESERVE;
#else
    constexpr int kRoom = MAP_PRIVATE | MAP_ANON;
#endif
    void* memory = mmap(nullptr, reserved, kAccess, kRoom, -1, 0);
    if (memory == MAP_FAILED) {
      return nullptr;
    }
    const int descriptor = fileno(file_.get());
    const auto from = static_cast<off_t>(offset);
    if (mmap(memory, used, kAccess, MAP_PRIVATE | MAP_FIXED, descriptor, from) == MAP_FAILED) {
      munmap(memory, reserved);
      return nullptr;
    }
    return memory;
#else
    static_cast<void>(offset), static_cast<void>(used), static_cast<void>(reserved);
    return nullptr;
#endif
  }

  static void unmap(void* memory, std::size_t bytes) noexcept {
#if defined(__unix__) || defined(__APPLE__)
    munmap(memory, bytes);
#else
    static_cast<void>(memory), static_cast<void>(bytes);
#endif
  }

 private:
  File file_;
};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
