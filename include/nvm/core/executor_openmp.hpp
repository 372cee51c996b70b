// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#ifndef _OPENMP
#error "nvm/core/executor_openmp.hpp needs OpenMP: compile with -fopenmp or link OpenMP::OpenMP_CXX"
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace nvm {

/// Like SerialExecutor, on OpenMP's threads. OMP_NUM_THREADS or omp_set_num_threads limit them.
struct OpenMpExecutor {
  template <class Body>
  void for_blocks(std::size_t size, std::size_t grain, const Body& body) const {
    const auto blocks = static_cast<std::int64_t>((size + grain - 1) / grain);
#pragma omp parallel for schedule(dynamic)
    for (std::int64_t block = 0; block < blocks; ++block) {
      const std::size_t begin = static_cast<std::size_t>(block) * grain;
      body(begin, std::min(begin + grain, size));
    }
  }
};

}  // namespace nvm
