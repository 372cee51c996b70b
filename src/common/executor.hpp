// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <memory>

#include "nvm/core/executor.hpp"
#include "nvm/core/executor_tbb.hpp"
#include "nvm/core/require.hpp"

namespace nvm {

/// Runs blocks on as many threads as a configuration asks for. The blocks are the same for any
/// number of threads (see SerialExecutor). Copies share their threads.
class Executor {
 public:
  /// `threads`: 1 to 256; 1 uses the calling thread alone.
  explicit Executor(int threads = 1) {
    require(threads >= 1 && threads <= 256, "threads", threads, "1 to 256");
    if (threads > 1) {
      arena_ = std::make_shared<tbb::task_arena>(threads);
    }
  }

  template <class Body>
  void for_blocks(std::size_t size, std::size_t grain, const Body& body) const {
    if (arena_) {
      arena_->execute([&] { TbbExecutor().for_blocks(size, grain, body); });
    } else {
      SerialExecutor().for_blocks(size, grain, body);
    }
  }

 private:
  std::shared_ptr<tbb::task_arena> arena_;
};

}  // namespace nvm
