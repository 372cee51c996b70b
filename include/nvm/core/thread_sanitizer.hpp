// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#if defined(__SANITIZE_THREAD__)
#define NVM_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define NVM_THREAD_SANITIZER
#endif
#endif

#ifdef NVM_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace nvm::detail {

/// Something that one thread does before another goes on, inside a library that ThreadSanitizer
/// does not see into: the other is ordered after all calls of reached() before its own passed().
/// Without ThreadSanitizer nothing is done.
class SynchronisationPoint {
 public:
#ifdef NVM_THREAD_SANITIZER
  void reached() { __tsan_release(this); }
  void passed() { __tsan_acquire(this); }

 private:
  char address_ = 0;
#else
  void reached() {}
  void passed() {}
#endif
};

inline SynchronisationPoint tasks_forked;
inline SynchronisationPoint tasks_joined;

}  // namespace nvm::detail
