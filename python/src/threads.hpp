// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

#include "common/executor.hpp"
#include "whole_number.hpp"

namespace nvm::python {

/// The executor for `size` elements: `threads` as a caller gives it, 0 for all cores; fewer than
/// `worth` elements stay in the calling thread. Throws ValueError.
inline Executor make_executor(const Integer& threads, std::size_t size, std::size_t worth) {
  constexpr int kMost = 256;
  const auto given = static_cast<int>(threads.from("threads", 0, kMost));
  const int wanted = given == 0 ? std::min(tbb::this_task_arena::max_concurrency(), kMost) : given;
  return Executor(size < worth ? 1 : wanted);
}

}  // namespace nvm::python
