// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/simulate_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/interruption.hpp"
#include "app/number_between.hpp"
#include "app/results.hpp"
#include "config/schema.hpp"
#include "io/file/doing.hpp"
#include "sim/scene_file.hpp"
#include "sim/sensor_model.hpp"
#include "sim/simulation.hpp"

namespace nvm::app {
namespace {

struct SimulateArguments {
  std::string scene;
  std::string folder;
  std::string sensor = "mid360";
  std::uint64_t seed = 1;
  double duration = 0.0;
  std::vector<std::string> overrides;
  std::string options_file;
  bool lists_scenes = false;
  bool lists_sensors = false;
  bool prints_options = false;
};

void list_scenes() {
  for (const std::string& name : sim::shipped_scenes()) {
    fmt::print("{:<12} {}\n", name, sim::load_scene(name).description);
  }
}

void list_sensors() {
  for (const sim::SensorModel& sensor : sim::sensor_models()) {
    fmt::print("{:<12} {}\n", sensor.name, sensor.description);
  }
}

void simulate(const SimulateArguments& arguments, const sim::SimulationOptions& options) {
  if (arguments.scene.empty() || arguments.folder.empty()) {
    throw CLI::RequiredError("each of SCENE and --out");
  }
  const sim::Scene scene = sim::load_scene(arguments.scene);
  const Interruption interruption;
  io::doing("making way for " + arguments.folder, [&] { remove_leftovers(arguments.folder); });
  const auto summary = sim::simulate(scene, options, arguments.folder, [&] {
    interruption.check("nothing is left in " + arguments.folder);
  });
  fmt::print(
      "{}: {} scans, {} points, {} IMU samples, {:.1f} s, {:.1f} m\n",
      arguments.folder,
      summary.scans,
      summary.points,
      summary.imu_samples,
      summary.duration,
      summary.path_length);
  interruption.check(arguments.folder + " is whole");
}

void run(const SimulateArguments& arguments) {
  sim::SimulationOptions options = sim::options_for(arguments.sensor);
  options.seed = arguments.seed;
  options.duration = arguments.duration;
  config::Schema schema;
  sim::bind(schema, options);
  if (!arguments.options_file.empty()) {
    schema.read_file(arguments.options_file);
  }
  for (const std::string& assignment : arguments.overrides) {
    schema.set(assignment);
  }
  if (arguments.lists_scenes) {
    list_scenes();
  } else if (arguments.lists_sensors) {
    list_sensors();
  } else if (arguments.prints_options) {
    fmt::print("{}", schema.to_yaml());
  } else {
    simulate(arguments, options);
  }
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("simulate", "Simulate a LiDAR and an IMU in a scene");
  const auto arguments = std::make_shared<SimulateArguments>();
  command->add_option("SCENE", arguments->scene, "Name of a shipped scene, or a scene file");
  command->add_option("--out", arguments->folder, "Folder of the sequence; must not exist");
  command->add_option("--sensor", arguments->sensor, "LiDAR, see --list-sensors")
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Of all noise and of the walk's details")
      ->check([](const std::string& seed) {
        return std::string(seed.rfind('-', 0) == 0 ? "must not be below zero" : "");
      })
      ->capture_default_str();
  command->add_option("--duration", arguments->duration, "[s]; 0: to the end of the route")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
  command->add_option("--config", arguments->options_file, "YAML file of options")
      ->check(CLI::ExistingFile);
  command->add_option("--set", arguments->overrides, "An option, as in lidar.range_noise=0.02")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--list-scenes", arguments->lists_scenes, "Print the shipped scenes");
  command->add_flag("--list-sensors", arguments->lists_sensors, "Print the sensors");
  command->add_flag("--print-options", arguments->prints_options, "Print all options as YAML");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nvm::app
