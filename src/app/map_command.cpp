// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/map_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/failure.hpp"
#include "app/map_builder.hpp"
#include "app/number_between.hpp"
#include "app/results.hpp"
#include "app/run_options.hpp"
#include "app/say.hpp"
#include "eval/trajectory/association.hpp"
#include "eval/trajectory/gaps.hpp"
#include "io/file/doing.hpp"
#include "io/file/file.hpp"
#include "io/result/map_origin.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "io/sequence/trajectory_io.hpp"

namespace nvm::app {

namespace {

struct MapArguments {
  std::string input;
  std::string poses;
  std::string folder;
  std::optional<double> max_gap;  ///< [s]
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
  while (const std::optional<Scan> scan = reader->next_scan()) {
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

/// Of the scans that were read.
struct ScanTimes {
  std::size_t count = 0;
  double first = 0.0;  ///< [s]
  double last = 0.0;

  void add(double time) {
    first = count++ == 0 ? time : first;
    last = time;
  }
};

/// "poses from ... to ..., scans from ... to ...".
std::string describe(const Trajectory& poses, const ScanTimes& scans) {
  return fmt::format(
      "poses {}, scans {}",
      poses.empty() ? "none" : eval::describe_span(poses.front().time, poses.back().time),
      eval::describe_span(scans.first, scans.last));
}

/// Why a map has no points, in one line.
std::string why_empty(
    const std::string& input,
    const MapArguments& arguments,
    const MapBuilder& builder,
    const Trajectory& poses,
    const ScanTimes& scans) {
  if (scans.count == 0) {
    return input + ": has no scans";
  }
  if (builder.placed().empty()) {
    return arguments.poses + ": has no pose at the time of any scan: " + describe(poses, scans);
  }
  return input + ": the map has no points: " + builder.inserted().why_empty();
}

/// Throws Failure when nothing is worth keeping, for the reason `why`.
void check_useful(std::size_t map_points, const Ending& ending, const std::string& why) {
  if (map_points > 0) {
    return;
  }
  if (ending.signal != 0) {
    throw Failure("interrupted before there was a map", kExitSignal + ending.signal);
  }
  throw Failure(ending.error.empty() ? why : ending.error, kExitError);
}

void print_origin(const Eigen::Vector3d& origin) {
  if (!origin.isZero(0.0)) {
    say(fmt::format(
        "note: poses are far from zero, so map.nvm counts from {} {} {} m, which "
        "map_origin.txt keeps for nvm export; map.ply and trajectory.tum are where the poses are",
        origin.x(),
        origin.y(),
        origin.z()));
  }
}

/// Says what the poses leave to guess: where a sensor that is carried went between them.
void print_gaps(const Trajectory& poses, const MapBuilder& builder, double max_gap) {
  constexpr double kSparse = 0.25;  // [s]
  const std::vector<double>& in_gaps = builder.in_gaps();
  if (!in_gaps.empty()) {
    say(fmt::format(
        "warning: {} scans are left out, the first at {:.3f} s: they lie between poses more than "
        "{:.2f} s apart (--max-gap)",
        in_gaps.size(),
        in_gaps.front(),
        max_gap));
  }
  const auto is_between = [&](const StampedPose& placed) {
    return eval::gap_around(poses, placed.time) > kSparse;
  };
  const auto between = std::count_if(builder.placed().begin(), builder.placed().end(), is_between);
  if (between > 0) {
    say(fmt::format(
        "warning: {} scans lie between poses {:.2f} s apart: a straight way is taken there, and a "
        "sensor that is carried leaves it by centimetres. Give a pose at each scan's end",
        between,
        eval::usual_step(poses)));
  }
}

/// Reads the scans and publishes what became of them.
void build_map(
    const MapArguments& arguments,
    const Trajectory& poses,
    io::SequenceReader& reader,
    const RunOptions& options) {
  const Eigen::Vector3d origin = io::choose_origin(poses);
  const double max_gap = arguments.max_gap.value_or(eval::default_max_gap(poses));
  MapBuilder builder = io::doing(making_map(options.pipeline.map), [&] {
    return MapBuilder(options.pipeline, io::moved(poses, -origin), max_gap);
  });
  const Interruption interruption;
  io::ResultFolder results(arguments.folder);
  announce_unfinished(results);
  ScanTimes scans;
  Ending ending = use_scans(reader, interruption, [&](const Scan& scan) {
    scans.add(scan.t_end);
    builder.add(scan);
    return "";
  });
  print_notes(reader.info());
  print_gaps(poses, builder, max_gap);
  const std::size_t map_points = builder.map().points().size();
  check_useful(
      map_points,
      ending,
      why_empty(name_of(arguments.input, reader.info()), arguments, builder, poses, scans));
  io::write_tum(results.path() + "/trajectory.tum", io::moved(builder.placed(), origin));
  write_map(results, builder.map(), origin, ending);
  results.publish();
  print_origin(origin);
  fmt::print(
      "{}: {} of {} scans placed, {} map points\n",
      arguments.folder,
      builder.placed().size(),
      scans.count,
      map_points);
  check_ending(ending, arguments.folder);
  if (2 * builder.placed().size() < scans.count) {
    throw Failure(
        arguments.poses + ": has no pose for most scans: " + describe(poses, scans), kExitUnusable);
  }
}

void read_and_build(const MapArguments& arguments, RunOptions& options) {
  const auto reader = open_input(arguments.input, options.input);
  check_apart(name_of(arguments.input, reader->info()), arguments.folder);
  options.pipeline.inertial.T_imu_lidar = lidar_extrinsic(options, reader->info());
  const Trajectory poses =
      io::doing("reading " + arguments.poses, [&] { return read_poses(arguments, options.input); });
  build_map(arguments, poses, *reader, options);
}

}  // namespace

void add_map_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("map", "Build a two-sided map from scans at known poses");
  const auto arguments = std::make_shared<MapArguments>();
  command->add_option("SCANS", arguments->input, "Sequence, as for nvm run");
  command->add_option(
      "--poses",
      arguments->poses,
      "TUM file, or KITTI file with a line per scan: the pose of the body at least at each scan's "
      "end");
  command->add_option("--out", arguments->folder, "Folder of map.ply, map.nvm and trajectory.tum");
  command
      ->add_option(
          "--max-gap",
          arguments->max_gap,
          "Scans between poses farther apart are left out [s]; default: 0.25, or 1.5 usual steps "
          "up to 1.5")
      ->check(number_between(0.0, 1e6));
  add_run_options(*command, arguments->options);
  command->callback([arguments] {
    std::optional<RunOptions> options = read_run_options(arguments->options);
    if (!options) {
      return;
    }
    if (arguments->input.empty() || arguments->poses.empty() || arguments->folder.empty()) {
      throw CLI::RequiredError("each of SCANS, --poses and --out");
    }
    read_and_build(*arguments, *options);
  });
}

}  // namespace nvm::app
