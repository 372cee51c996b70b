// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <gtest/gtest.h>

#include "nvm/core/thread_sanitizer.hpp"

/// Skips a test whose threads belong to `library`, which ThreadSanitizer does not see into: it
/// would take every hand-over between its threads for a race.
#ifdef NVM_THREAD_SANITIZER
#define NVM_SKIP_UNDER_THREAD_SANITIZER(library) \
  GTEST_SKIP() << "ThreadSanitizer does not see the synchronisation inside " library
#else
#define NVM_SKIP_UNDER_THREAD_SANITIZER(library) static_cast<void>(0)
#endif

/// Skips a test that limits the memory or the files of a program: a sanitizer's own part of it
/// needs terabytes of addresses and writes before main(), so it does not even start.
#if defined(NVM_THREAD_SANITIZER) || defined(__SANITIZE_ADDRESS__)
#define NVM_SKIP_UNDER_SANITIZERS() \
  GTEST_SKIP() << "A sanitizer does not start within limits of the system"
#else
#define NVM_SKIP_UNDER_SANITIZERS() static_cast<void>(0)
#endif
