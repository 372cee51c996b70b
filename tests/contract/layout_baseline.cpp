// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "contract/layout.hpp"

const nvm::test::Layouts nvm::test::kBaselineLayouts = NVM_TEST_PUBLIC_LAYOUTS;
