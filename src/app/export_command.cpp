// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/export_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/doing.hpp"
#include "app/interruption.hpp"
#include "app/results.hpp"
#include "io/result/map_cloud.hpp"
#include "io/result/map_files.hpp"
#include "io/result/map_origin.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::app {

namespace {

struct ExportArguments {
  std::string map;
  std::string cloud;
};

void write_cloud(const ExportArguments& arguments) {
  doing("making way for " + arguments.cloud, [&] { remove_leftovers(arguments.cloud); });
  const Eigen::Vector3d origin = io::read_origin(arguments.map);
  const io::MapCloud cloud = doing("exporting " + arguments.map, [&] {
    return io::map_cloud_of(without_sightings(load_map(arguments.map).points()), origin);
  });
  const Interruption interruption;
  doing("writing " + arguments.cloud, [&] { io::write_map_cloud(arguments.cloud, cloud); });
  interruption.check(arguments.cloud + " is whole");
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("export", "Write a saved map as points with normals and sides");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("MAP", arguments->map, "A map.nvm file")->required();
  command->add_option("--out", arguments->cloud, "A .ply or .pcd file")->required();
  command->callback([arguments] { write_cloud(*arguments); });
}

}  // namespace nvm::app
