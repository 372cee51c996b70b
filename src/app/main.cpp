// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "app/doing.hpp"
#include "app/evaluate_command.hpp"
#include "app/export_command.hpp"
#include "app/failure.hpp"
#include "app/info_command.hpp"
#include "app/map_command.hpp"
#include "app/run_command.hpp"
#include "app/say.hpp"
#include "app/simulate_command.hpp"
#include "app/walls_command.hpp"
#include "config/nearest_name.hpp"
#include "nvm/version.hpp"

namespace {

/// What is wrong with the arguments, in one line.
std::string failure_message(const CLI::App*, const CLI::Error& error) {
  return fmt::format("nvm: {} (see nvm --help)\n", error.what());
}

/// "; did you mean run?", for a command that does not exist.
std::string suggestion(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  const std::optional<std::string> nearest = nvm::config::nearest_name(name, names);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

int parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError& error) {
    const std::string first = argv[1];
    if (!app.get_subcommands().empty() || first[0] == '-') {
      app.exit(error);
    } else {
      nvm::app::say("no command " + first + suggestion(app, first) + " (see nvm --help)");
    }
    return nvm::app::kExitUsage;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? nvm::app::kExitSuccess : nvm::app::kExitUsage;
  }
  if (app.get_subcommands().empty()) {
    fmt::print("{}", app.help());
  }
  return nvm::app::kExitSuccess;
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
  nvm::app::add_walls_command(app);
  return parse(app, argc, argv);
}

int report(const std::string& message, int status) {
  const std::string prefix = "nvm: ";  // which messages of the core have already
  nvm::app::say(message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that gets too large is an error like a full disk
  try {
    return nvm::app::doing("working", [&] { return run(argc, argv); });
  } catch (const nvm::app::Failure& failure) {
    return report(failure.what(), failure.status());
  } catch (const std::exception& error) {
    return report(error.what(), nvm::app::kExitError);
  }
}
