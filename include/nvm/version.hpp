// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// The only place where the version is written; CMake parses these three lines.
#define NVM_VERSION_MAJOR 0
#define NVM_VERSION_MINOR 1
#define NVM_VERSION_PATCH 0
