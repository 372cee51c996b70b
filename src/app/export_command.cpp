// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/export_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/map_files.hpp"
#include "io/map_cloud.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm::app {

namespace {

struct ExportArguments {
  std::string map;
  std::string cloud;
};

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("export", "Write a saved map as points with normals and sides");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("MAP", arguments->map, "A map.nvm file")->required();
  command->add_option("--out", arguments->cloud, "A .ply or .pcd file")->required();
  command->callback([arguments] {
    io::write_map_cloud(arguments->cloud, map_cloud_of(load_map(arguments->map).points()));
  });
}

}  // namespace nvm::app
