// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#if __cplusplus < 201703L
#error "nvm needs C++17: change -std=c++14 in the host's CMakeLists.txt; see docs/adapters/ivox.md"
#endif

// Stands in for the header of the same name that Point-LIO includes: put this folder's parent first
// among the include directories. docs/adapters/ivox.md
#include "adapters/ivox/ivox.hpp"
