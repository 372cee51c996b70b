// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#ifndef _OPENMP
#error "nvm/core/executor_openmp.hpp needs OpenMP: compile with -fopenmp or link OpenMP::OpenMP_CXX"
#endif

#include <cstddef>
#include <cstdint>

#include "nvm/core/executor.hpp"
#include "nvm/core/target.hpp"

namespace nvm {
inline namespace NVM_TARGET {

/// Like SerialExecutor, on OpenMP's threads. OMP_NUM_THREADS or omp_set_num_threads limit them.
struct OpenMpExecutor {
  template <class Body>
  void for_blocks(std::size_t size, std::size_t grain, const Body& body) const {
    const detail::Blocks blocks(size, grain);
    const auto count = static_cast<std::int64_t>(blocks.count());
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t block = 0; block < count; ++block) {
      blocks.run(static_cast<std::size_t>(block), body);
    }
  }
};

}  // namespace NVM_TARGET
}  // namespace nvm
