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
