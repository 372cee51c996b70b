// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/map_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/map_builder.hpp"
#include "app/map_files.hpp"
#include "app/progress_bar.hpp"
#include "app/run_options.hpp"
#include "io/file.hpp"
#include "io/sequence_reader.hpp"
#include "io/trajectory_io.hpp"

namespace nvm::app {

namespace {

struct MapArguments {
  std::string input;
  std::string poses;
  std::string folder;
  RunOptionArguments options;
};

bool is_kitti(const std::string& path) {
  std::istringstream text(io::read_file(path));
  std::string line;
  while (std::getline(text, line) && line[0] == '#') {
  }
  std::istringstream words(line);
  constexpr std::ptrdiff_t kKittiNumbers = 12;
  return std::distance(std::istream_iterator<std::string>(words), {}) == kKittiNumbers;
}

std::vector<double> scan_times(const std::string& input, const io::SequenceOptions& options) {
  std::vector<double> times;
  const auto reader = io::open_sequence(input, options);
  while (const std::optional<lio::Scan> scan = reader->next_scan()) {
    times.push_back(scan->t_end);
  }
  return times;
}

/// T_map_body at the scans' ends.
Trajectory read_poses(const MapArguments& arguments, const io::SequenceOptions& options) {
  return is_kitti(arguments.poses)
             ? io::read_kitti_poses(arguments.poses, scan_times(arguments.input, options))
             : io::read_tum(arguments.poses);
}

void build_map(const MapArguments& arguments, RunOptions& options) {
  const auto reader = io::open_sequence(arguments.input, options.input);
  options.pipeline.inertial.T_imu_lidar = lidar_extrinsic(options, reader->info());
  MapBuilder builder(options.pipeline, read_poses(arguments, options.input));
  make_output_folder(arguments.folder);
  std::size_t scans = 0;
  {
    ProgressBar progress(reader->info().scan_count);
    for (; const std::optional<lio::Scan> scan = reader->next_scan(); ++scans) {
      builder.add(*scan);
      progress.step("");
    }
  }
  if (builder.placed().empty()) {
    io::fail(arguments.poses, "has no pose at the time of any scan");
  }
  write_map_files(builder.map(), arguments.folder);
  io::write_tum(arguments.folder + "/trajectory.tum", builder.placed());
  fmt::print(
      "{}: {} of {} scans placed, {} map points\n",
      arguments.folder,
      builder.placed().size(),
      scans,
      builder.map().size());
}

}  // namespace

void add_map_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("map", "Build a two-sided map from scans at known poses");
  const auto arguments = std::make_shared<MapArguments>();
  command->add_option("SCANS", arguments->input, "Sequence, as for nvm run");
  command->add_option(
      "--poses",
      arguments->poses,
      "TUM file, or KITTI file with a line per scan: the pose of the body at each scan's end");
  command->add_option("--out", arguments->folder, "Folder of map.ply, map.nvm and trajectory.tum");
  add_run_options(*command, arguments->options);
  command->callback([arguments] {
    std::optional<RunOptions> options = read_run_options(arguments->options);
    if (!options) {
      return;
    }
    if (arguments->input.empty() || arguments->poses.empty() || arguments->folder.empty()) {
      throw CLI::RequiredError("each of SCANS, --poses and --out");
    }
    build_map(*arguments, *options);
  });
}

}  // namespace nvm::app
