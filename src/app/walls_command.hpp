// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace CLI {
class App;
}

namespace nvm::app {

/// Adds the subcommand "walls" to `app`. It throws std::exception with one line about what is
/// wrong.
void add_walls_command(CLI::App& app);

}  // namespace nvm::app
