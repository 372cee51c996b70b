// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/walls_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/interruption.hpp"
#include "app/say.hpp"
#include "io/file/doing.hpp"
#include "io/file/file.hpp"
#include "io/result/map_cloud.hpp"
#include "io/result/map_files.hpp"
#include "io/result/map_in.hpp"
#include "io/result/map_origin.hpp"
#include "io/result/tile_store.hpp"
#include "nvm/map/serialization.hpp"
#include "survey/keyframes_beside.hpp"
#include "survey/plan.hpp"
#include "survey/survey.hpp"
#include "survey/survey_files.hpp"
#include "survey/survey_table.hpp"

namespace nvm::app {

namespace {

struct WallsArguments {
  std::string map;
  std::string folder;
  survey::SurveyOptions options;
};

bool is_cloud(const std::string& path) {
  const std::string extension = io::extension_of(path);
  return extension == ".ply" || extension == ".pcd";
}

io::MapCloud read_map(const std::string& path) {
  if (is_cloud(path)) {
    return io::read_map_cloud(path);
  }
  if (std::filesystem::is_directory(path)) {
    return io::read_tile_store(path);
  }
  return io::map_cloud_of(load_map(path), io::read_origin(path));
}

/// What tells of passes over the map file `map`; without it they are unknown.
survey::KeyframeSource keyframes_of(const std::string& map) {
  if (is_cloud(map) || std::filesystem::is_directory(map)) {
    return nullptr;
  }
  try {
    return survey::keyframes_beside(map, io::read_origin(map));
  } catch (const std::runtime_error& error) {
    say(std::string("note: ") + error.what() + "; which sides were seen in one pass is unknown");
    return nullptr;
  }
}

void print_summary(const survey::Survey& found, const std::string& folder) {
  fmt::print("{}", survey::screen_table(found));
  fmt::print(
      "{} seen from both sides, {} columns and furniture, {} faces seen from one side\n",
      found.walls.size(),
      found.bodies.size(),
      found.faces.size());
  fmt::print("{0}/walls.html, {0}/walls.json, {0}/plan.dxf\n", folder);
}

/// The extent of `cloud` over the number of points along it, as if it were one surface [m].
double spacing_of(const io::MapCloud& cloud) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : cloud.positions) {
    if (p.allFinite()) {
      box.extend(p);
    }
  }
  return box.isEmpty()
             ? 0.0
             : box.diagonal().norm() / std::sqrt(static_cast<double>(cloud.positions.size()));
}

void refuse_nothing(const WallsArguments& arguments, const io::MapCloud& cloud) {
  constexpr double kFarApart = 5.0;  // [m]
  const double spacing = spacing_of(cloud);
  throw std::runtime_error(fmt::format(
      "{}: no plane of {} m² among {} points; {}",
      arguments.map,
      arguments.options.min_area,
      cloud.positions.size(),
      spacing > kFarApart
          ? fmt::format("they lie about {:.0f} m apart: are they in millimetres?", spacing)
          : "a map of more scans, or --min-area, may have some"));
}

void say_notes(const survey::Survey& found, const io::MapCloud& cloud, double plan_height) {
  if (found.left_out > 0) {
    say(fmt::format(
        "note: {} of {} points were left out: without a position, without a normal, or far from "
        "all others",
        found.left_out,
        cloud.positions.size()));
  }
  constexpr double kRough = 5e-4;  // [m]
  if (found.rounding > kRough) {
    say(fmt::format(
        "note: so far from zero float32 coordinates are rounded to {:.0f} mm, and walls with them; "
        "write the map with float64, or nearer to zero",
        1e3 * found.rounding));
  }
  if (found.is_inside_out) {
    say("note: normals seem to point into the walls instead of to where points were seen from; "
        "with them turned around the list will be another");
  }
  const survey::Plan plan = survey::make_plan(found, plan_height);
  if (plan.walls.empty() && plan.faces.empty()) {
    say(fmt::format("note: the plan is empty: nothing is {} m above the floor", plan_height));
  }
}

void list_walls(const WallsArguments& arguments) {
  arguments.options.validate();
  const std::string map = io::map_in(arguments.map);
  const io::MapCloud cloud = io::doing("loading " + map, [&] { return read_map(map); });
  const survey::Survey found = io::doing("looking for walls", [&] {
    try {
      return survey::survey_walls(cloud, arguments.options, keyframes_of(map));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(arguments.map + ": " + error.what());
    }
  });
  if (found.walls.empty() && found.bodies.empty() && found.faces.empty()) {
    refuse_nothing(arguments, cloud);
  }
  say_notes(found, cloud, arguments.options.plan_height);
  const Interruption interruption;
  io::doing("writing " + arguments.folder, [&] {
    survey::write_survey(found, arguments.options.plan_height, arguments.folder);
  });
  print_summary(found, arguments.folder);
  interruption.check(arguments.folder + " holds all results");
}

}  // namespace

void add_walls_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "walls", "List the walls, slabs and doors of a map, measured, and draw a floor plan");
  const auto arguments = std::make_shared<WallsArguments>();
  survey::SurveyOptions& options = arguments->options;
  command
      ->add_option(
          "MAP",
          arguments->map,
          "A folder of nvm run, a map.nvm, a store of tiles, or a PLY or PCD with normals")
      ->required();
  command->add_option("--out", arguments->folder, "Folder of the results")->required();
  command->add_option("--height", options.plan_height, "Of the plan above the floor [m]")
      ->capture_default_str();
  command->add_option("--min-area", options.min_area, "That both sides show [m²]")
      ->capture_default_str();
  command->add_option("--max-thickness", options.max_thickness, "Of a wall [m]")
      ->capture_default_str();
  command->add_option("--max-gap", options.max_gap, "That a face goes on behind [m]")
      ->capture_default_str();
  command
      ->add_option(
          "--drift", options.drift, "Standard deviation of the pose between two sides' passes [m]")
      ->capture_default_str();
  command->callback([arguments] { list_walls(*arguments); });
}

}  // namespace nvm::app
