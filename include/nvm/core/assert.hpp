// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cassert>

/// Checks an invariant of nvm itself, never user input; compiled out with NDEBUG.
#define NVM_ASSERT(condition) assert(condition)
