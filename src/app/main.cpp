// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluate_command.hpp"
#include "app/export_command.hpp"
#include "app/failure.hpp"
#include "app/info_command.hpp"
#include "app/interruption.hpp"
#include "app/map_command.hpp"
#include "app/merge_command.hpp"
#include "app/run_command.hpp"
#include "app/say.hpp"
#include "app/simulate_command.hpp"
#include "app/walls_command.hpp"
#include "common/kept_memory.hpp"
#include "config/nearest_name.hpp"
#include "io/file/doing.hpp"
#include "nvm/version.hpp"

namespace {

/// The command that the arguments name, or the program.
const CLI::App& command_of(const CLI::App& app) {
  const std::vector<CLI::App*> commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

/// " (see nvm run --help)".
std::string see_help(const CLI::App& app) {
  const CLI::App& command = command_of(app);
  return &command == &app ? " (see nvm --help)" : " (see nvm " + command.get_name() + " --help)";
}

/// What is wrong with the arguments, in one line.
std::string failure_message(const CLI::App* app, const CLI::Error& error) {
  return fmt::format("nvm: {}{}\n", error.what(), see_help(*app));
}

/// "; did you mean run?", for a name that does not exist.
std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
  const std::optional<std::string> nearest = nvm::config::nearest_name(name, known);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

/// "nvm has no command rum; did you mean run?", for an argument that nothing takes.
std::string why_unexpected(const CLI::App& app, const std::string& argument) {
  const CLI::App& command = command_of(app);
  const std::string owner = &command == &app ? "nvm" : "nvm " + command.get_name();
  std::vector<std::string> known;
  if (argument[0] == '-') {
    const std::string name = argument.substr(0, argument.find('='));
    for (const CLI::Option* option : command.get_options()) {
      if (!option->get_lnames().empty()) {
        known.push_back("--" + option->get_lnames().front());
      }
    }
    return owner + " has no option " + name + suggestion(name, known);
  }
  if (&command != &app) {
    return owner + " has no use for the argument " + argument;
  }
  for (const CLI::App* other : app.get_subcommands({})) {
    known.push_back(other->get_name());
  }
  return "no command " + argument + suggestion(argument, known);
}

int parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> unexpected = app.remaining(true);
    if (unexpected.empty()) {
      app.exit(error);
    } else {
      nvm::app::say(why_unexpected(app, unexpected.front()) + see_help(app));
    }
    return nvm::app::kExitUsage;
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
  nvm::app::add_merge_command(app);
  return parse(app, argc, argv);
}

int report(const std::string& message, int status) {
  const std::string prefix = "nvm: ";  // which messages of the core have already
  nvm::app::say(message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  nvm::keep_freed_memory();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that gets too large is an error like a full disk
  nvm::app::say_when_interrupted();
  try {
    return nvm::io::doing("working", [&] { return run(argc, argv); });
  } catch (const nvm::app::Failure& failure) {
    return report(failure.what(), failure.status());
  } catch (const std::exception& error) {
    return report(error.what(), nvm::app::kExitError);
  }
}
