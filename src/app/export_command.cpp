// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/export_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "app/interruption.hpp"
#include "app/results.hpp"
#include "io/file/doing.hpp"
#include "io/file/pending_files.hpp"
#include "io/result/map_cloud.hpp"
#include "io/result/map_files.hpp"
#include "io/result/map_in.hpp"
#include "io/result/map_origin.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm::app {

namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string map;
  std::string out;
};

bool is_image(const std::string& path) { return fs::path(path).extension() == ".image"; }

void write_image(const VoxelMap& map, const Eigen::Vector3d& origin, const std::string& path) {
  io::PendingFiles files(path);
  save_map_image(map, files.temporary());
  io::write_origin_unless_told(path, origin, files.temporary());
  files.commit();
}

void write_export(const ExportArguments& arguments) {
  io::doing("making way for " + arguments.out, [&] { remove_leftovers(arguments.out); });
  const Eigen::Vector3d origin = io::read_origin(arguments.map);
  const VoxelMap map =
      io::doing("loading " + arguments.map, [&] { return load_map(arguments.map); });
  const Interruption interruption;
  io::doing("writing " + arguments.out, [&] {
    if (is_image(arguments.out)) {
      write_image(map, origin, arguments.out);
    } else {
      io::write_map_cloud(arguments.out, io::map_cloud_of(map, origin));
    }
  });
  interruption.check(arguments.out + " is whole");
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "export", "Write a saved map as points with normals and sides, or as an image to be mapped");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("MAP", arguments->map, "A map.nvm file, or a folder of results")->required();
  command
      ->add_option(
          "--out",
          arguments->out,
          "A .ply or .pcd file, or a .image, which programs load in milliseconds and share")
      ->required();
  command->callback([arguments] {
    arguments->map = io::map_in(arguments->map);
    write_export(*arguments);
  });
}

}  // namespace nvm::app
