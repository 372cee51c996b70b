// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace CLI {
class App;
}

namespace nvm::app {

/// Adds the subcommand "simulate" to `app`. It throws what sim::simulate throws.
void add_simulate_command(CLI::App& app);

}  // namespace nvm::app
