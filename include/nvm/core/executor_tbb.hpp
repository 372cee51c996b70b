// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

#include "nvm/core/executor.hpp"
#include "nvm/core/target.hpp"
#include "nvm/core/thread_sanitizer.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Like SerialExecutor, on the threads of oneTBB. Limit them with tbb::global_control or a
/// tbb::task_arena.
struct TbbExecutor {
  template <class Body>
  void for_blocks(std::size_t size, std::size_t grain, const Body& body) const {
    const detail::Blocks blocks(size, grain);
    const auto run_block = [&](std::size_t block) {
      detail::tasks_forked.passed();
      blocks.run(block, body);
      detail::tasks_joined.reached();
    };
    detail::tasks_forked.reached();
    tbb::parallel_for(std::size_t{0}, blocks.count(), run_block);
    detail::tasks_joined.passed();
  }
};

}  // namespace NVM_TARGET
}  // namespace nvm
