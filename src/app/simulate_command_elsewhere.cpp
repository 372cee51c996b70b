// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <CLI/CLI.hpp>

#include "app/failure.hpp"
#include "app/simulate_command.hpp"

namespace nvm::app {

/// In a program that was built without the simulator: says where there is one, whatever the
/// arguments.
void add_simulate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("simulate", "Simulate a LiDAR: with nvm-tools only");
  command->prefix_command();
  command->set_help_flag();
  command->callback([] {
    throw Failure(
        "this program was built without the simulator, which needs Embree: install nvm-tools, or "
        "build nvm from its sources (scripts/demo.sh makes build/release/bin/nvm)",
        kExitUsage);
  });
}

}  // namespace nvm::app
