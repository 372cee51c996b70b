// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace CLI {
class App;
}

namespace nvm::app {

/// Adds "nvm merge" to `app`.
void add_merge_command(CLI::App& app);

}  // namespace nvm::app
