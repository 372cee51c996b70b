// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>

#include "nvm/core/target.hpp"

namespace nvm {
inline namespace NVM_TARGET {}  // namespace NVM_TARGET
namespace detail {
inline namespace NVM_TARGET {

/// [0, size) in consecutive blocks of `grain` elements, of which the last may be shorter. A grain
/// of 0 counts as 1.
class Blocks {
 public:
  Blocks(std::size_t size, std::size_t grain)
      : size_(size), grain_(std::max<std::size_t>(grain, 1)) {}

  std::size_t count() const { return size_ / grain_ + (size_ % grain_ != 0 ? 1 : 0); }

  template <class Body>
  void run(std::size_t block, const Body& body) const {
    const std::size_t begin = block * grain_;
    body(begin, begin + std::min(grain_, size_ - begin));
  }

 private:
  std::size_t size_;
  std::size_t grain_;
};

}  // namespace NVM_TARGET
}  // namespace detail
inline namespace NVM_TARGET {

/// Runs `body(begin, end)` over consecutive blocks of [0, size) in the calling thread.
///
/// Every executor cuts [0, size) into the same blocks of `grain` elements (0 counts as 1), whatever
/// its number of threads, so that a result that depends on the block borders (a sum of floats, say)
/// is the same for all of them. `body` must be safe to call from several threads at once and must
/// not throw. See executor_tbb.hpp and executor_openmp.hpp.
struct SerialExecutor {
  template <class Body>
  void for_blocks(std::size_t size, std::size_t grain, const Body& body) const {
    const detail::Blocks blocks(size, grain);
    for (std::size_t block = 0; block < blocks.count(); ++block) {
      blocks.run(block, body);
    }
  }
};

}  // namespace NVM_TARGET
}  // namespace nvm
