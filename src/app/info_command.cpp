// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/info_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <memory>
#include <string>

#include "io/file/doing.hpp"
#include "io/result/map_in.hpp"
#include "io/result/map_origin.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/sighting.hpp"

namespace nvm::app {

namespace {

void print_info(const std::string& path) {
  const VoxelMap map = io::doing("loading " + path, [&] { return load_map(path); });
  const Eigen::Vector3d origin = io::read_origin(path);
  const MapOptions& options = map.options();
  const MapStats stats = map.stats();
  Eigen::AlignedBox3d bounds;
  std::size_t sightings = 0;
  map.for_each_point([&](const MapPoint& point) {
    bounds.extend(point.position + origin);
    sightings += is_sighting(point.normal) ? 1 : 0;
  });
  fmt::print("points            {}\n", stats.points - sightings);
  fmt::print("sightings         {}\n", sightings);
  fmt::print("voxels            {} of at most {}\n", stats.voxels, options.capacity);
  fmt::print("two-sided voxels  {}\n", stats.two_sided_voxels);
  fmt::print("surfaces          {}\n", stats.surfaces);
  fmt::print("voxel size        {} m\n", options.voxel_size);
  fmt::print("point distance    {} m\n", options.min_point_distance);
  visit_columns([&](const OptionInfo& info, auto kept, auto /*value*/) {
    if (options.columns.*kept) {
      fmt::print("column            {}\n", info.name);
    }
  });
  fmt::print(
      "memory            {:.1f} MB\n",
      static_cast<double>(stats.memory_bytes) / io::kBytesPerMegabyte);
  if (!bounds.isEmpty()) {
    fmt::print(
        "bounds            {:.2f} {:.2f} {:.2f} to {:.2f} {:.2f} {:.2f} m\n",
        bounds.min().x(),
        bounds.min().y(),
        bounds.min().z(),
        bounds.max().x(),
        bounds.max().y(),
        bounds.max().z());
  }
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "Say what a saved map holds");
  const auto path = std::make_shared<std::string>();
  command->add_option("MAP", *path, "A map.nvm file, or a folder of results")->required();
  command->callback([path] { print_info(io::map_in(*path)); });
}

}  // namespace nvm::app
