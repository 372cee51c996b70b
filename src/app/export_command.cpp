// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/export_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "app/doing.hpp"
#include "app/map_origin.hpp"
#include "app/say.hpp"
#include "io/map_cloud.hpp"
#include "io/map_files.hpp"
#include "io/pending_path.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm::app {

namespace {

struct ExportArguments {
  std::string map;
  std::string cloud;
};

void write_cloud(const ExportArguments& arguments) {
  for (const std::string& left : io::leftovers_of(arguments.cloud)) {
    say("note: " + left + ": was left by a program that was killed; removed");
    std::filesystem::remove(left);
  }
  const Eigen::Vector3d origin = read_origin(arguments.map);
  doing("exporting " + arguments.map, [&] {
    io::write_map_cloud(
        arguments.cloud, io::map_cloud_of(load_map(arguments.map).points(), origin));
  });
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
