// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// Two translation units of one program may be compiled for different instruction sets. Of an inline
// function that both have, the linker keeps one copy, whichever comes first: an old processor would
// meet instructions that it does not know in a unit that was compiled for it, or a new one run code
// for an old one. So nvm's functions and classes live in an inline namespace that is named after
// what the unit is compiled for, and a unit only ever calls its own. What units hand to each other,
// options, results and the VoxelMap, has one name: its layout does not depend on the instruction
// set, and its own code is always_inline (tests/contract/mixed_targets).
//
// That holds for all that a VoxelMap does. Normals and alignment also use templates of the standard
// library and of Eigen, which are shared like those that the program uses itself.
#if defined(__AVX512VL__) && defined(__AVX512BW__)
#define NVM_TARGET for_avx512
#elif defined(__AVX2__) && defined(__FMA__)
#define NVM_TARGET for_avx2_fma
#elif defined(__AVX2__)
#define NVM_TARGET for_avx2
#elif defined(__AVX__)
#define NVM_TARGET for_avx
#elif defined(__SSE4_2__)
#define NVM_TARGET for_sse4
#else
#define NVM_TARGET for_baseline
#endif

/// For the code of types that translation units for different instruction sets share.
#define NVM_SHARED [[gnu::always_inline]]

// The headers in which the time is spent are kernels: they are compiled once for the instruction
// set of the translation unit and, where that is plain x86-64, once more for AVX2, and the
// processor decides which of the two runs. Their code stands between macros that open a namespace
// for each of the two; they have guards in place of #pragma once, which map_kernels.hpp and
// normal_kernels.hpp take away before the second time.
#if defined(__SSE2__) && defined(__x86_64__) && !defined(__AVX2__) && !defined(_WIN32)
#define NVM_CHOOSES_KERNELS
#endif
#include "nvm/core/kernels_for_unit.hpp"
