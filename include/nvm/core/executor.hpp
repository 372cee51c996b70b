// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>

namespace nvm {

/// Runs `body(begin, end)` over consecutive blocks of [0, size) in the calling thread.
///
/// Every executor cuts [0, size) into the same blocks of `grain` elements, whatever its number of
/// threads, so that a result that depends on the block borders (a sum of floats, say) is the same
/// for all of them. `body` must be safe to call from several threads at once and must not throw.
/// See executor_tbb.hpp and executor_openmp.hpp.
struct SerialExecutor {
  template <class Body>
  void for_blocks(std::size_t size, std::size_t grain, const Body& body) const {
    for (std::size_t begin = 0; begin < size; begin += grain) {
      body(begin, std::min(begin + grain, size));
    }
  }
};

}  // namespace nvm
