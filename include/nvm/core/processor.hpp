// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/core/target.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

#ifdef NVM_CHOOSES_KERNELS
/// Whether the kernels for AVX2 run on this processor. Reads one word, which is set before main().
inline bool has_avx2() noexcept {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi") != 0 &&
         __builtin_cpu_supports("bmi2") != 0 && __builtin_cpu_supports("popcnt") != 0;
}
#endif

}  // namespace NVM_TARGET
}  // namespace nvm::detail
