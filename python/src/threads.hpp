// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>

#include "common/executor.hpp"

namespace nvm::python {

/// The executor for `size` elements: `threads` as a caller gives it, 0 for all cores; fewer than
/// `worth` elements stay in the calling thread. Throws std::invalid_argument.
inline Executor make_executor(int threads, std::size_t size, std::size_t worth) {
  const int wanted = threads == 0 ? tbb::this_task_arena::max_concurrency() : threads;
  require(threads >= 0 && threads <= 256, "threads", threads, "0 (all cores) to 256");
  return Executor(size < worth ? 1 : wanted);
}

}  // namespace nvm::python
