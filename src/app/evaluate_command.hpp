// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace CLI {
class App;
}

namespace nvm::app {

/// Adds the subcommand "evaluate" to `app`. It throws what the readers of nvm::eval throw.
void add_evaluate_command(CLI::App& app);

}  // namespace nvm::app
