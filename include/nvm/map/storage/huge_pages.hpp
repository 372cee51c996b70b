// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace nvm::detail {

/// Asks the operating system to back `bytes` bytes at `memory`, not yet touched, by pages of 2 MiB.
/// A map reads a few bytes here and there of much memory: with pages of 4 KiB most of these reads
/// first miss their translation, and each new page costs a fault (docs/performance.md). The first
/// pages stay small, so that a small map costs little. A hint, without effect where the system has
/// no such pages.
inline void prefer_huge_pages(void* memory, std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kHugePage = std::size_t{1} << 21;
  const std::size_t to_boundary = -reinterpret_cast<std::uintptr_t>(memory) % kHugePage;
  const std::size_t skipped = to_boundary + kHugePage;
  if (bytes >= skipped + kHugePage) {
    const std::size_t whole = (bytes - skipped) / kHugePage * kHugePage;
    static_cast<void>(madvise(static_cast<char*>(memory) + skipped, whole, MADV_HUGEPAGE));
  }
#else
  static_cast<void>(memory);
  static_cast<void>(bytes);
#endif
}

}  // namespace nvm::detail
