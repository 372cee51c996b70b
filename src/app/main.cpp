// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <string>

#include "app/evaluate_command.hpp"
#include "app/export_command.hpp"
#include "app/info_command.hpp"
#include "app/map_command.hpp"
#include "app/run_command.hpp"
#include "app/simulate_command.hpp"
#include "nvm/version.hpp"

namespace {

/// What is wrong with the arguments, in one line.
std::string failure_message(const CLI::App*, const CLI::Error& error) {
  return fmt::format("nvm: {} (see nvm --help)\n", error.what());
}

int run(int argc, char** argv) {
  CLI::App app("Two-sided, normal-aware mapping and odometry with LiDAR");
  app.name("nvm");
  app.set_version_flag(
      "--version",
      fmt::format("nvm {}.{}.{}", NVM_VERSION_MAJOR, NVM_VERSION_MINOR, NVM_VERSION_PATCH));
  app.require_subcommand(0, 1);
  app.failure_message(failure_message);
  nvm::app::add_run_command(app);
  nvm::app::add_map_command(app);
  nvm::app::add_info_command(app);
  nvm::app::add_export_command(app);
  nvm::app::add_simulate_command(app);
  nvm::app::add_evaluate_command(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {
      throw CLI::RequiredError("a command");
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    const std::string message = error.what();
    const char* prefix = message.rfind("nvm: ", 0) == 0 ? "" : "nvm: ";
    fmt::print(stderr, "{}{}\n", prefix, message);
    return EXIT_FAILURE;
  }
}
