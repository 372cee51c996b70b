// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstdlib>  // tells which C library it is

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace nvm {

/// Lets this process keep up to 32 MiB that it freed. glibc gives buffers as large as a cloud back
/// to the system with each free, and the next cloud waits for the same pages again, each filled
/// with zeros: half of what it took to hand a recording over by a pipe.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kKept = 1 << 25;          // [bytes]
  constexpr int kLargestBlock = 1 << 23;  // [bytes] of those that are kept: 131 072 points of 64
  mallopt(M_TRIM_THRESHOLD, kKept);
  mallopt(M_MMAP_THRESHOLD, kLargestBlock);
#endif
}

}  // namespace nvm
