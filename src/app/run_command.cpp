// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/change_recorder.hpp"
#include "app/prior_options.hpp"
#include "app/results.hpp"
#include "app/run_files.hpp"
#include "app/run_options.hpp"
#include "app/run_stream.hpp"
#include "app/run_summary.hpp"
#include "app/run_verdict.hpp"
#include "app/say.hpp"
#include "app/second_start.hpp"
#include "app/session_recorder.hpp"
#include "io/file/doing.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "lio/pipeline/pipeline_options.hpp"

namespace nvm::app {

namespace {

struct RunArguments {
  std::string input;
  std::string folder;
  std::string stream;
  std::string again;
  PriorArguments prior;
  RunOptionArguments options;
};

std::unique_ptr<lio::Pipeline> make_pipeline(
    const PriorArguments& prior, RunOptions& options, const io::SequenceInfo& info) {
  lio::PipelineOptions& pipeline = options.pipeline;
  pipeline.type = lio::resolve(pipeline.type, info.has_imu);
  pipeline.inertial.T_imu_lidar = lidar_extrinsic(options, info);
  if (!prior.map.empty()) {
    return make_prior_pipeline(prior, pipeline);
  }
  return io::doing(making_map(pipeline.map), [&] { return lio::make_pipeline(pipeline); });
}

using ScanProcess = std::function<lio::FrameResult(const Scan&)>;

/// What takes note of the frames of a run, besides its files.
struct Recorders {
  SessionRecorder session;
  ChangeRecorder changes;
  RunStream& stream;

  void add(const lio::FrameResult& frame, const lio::Pipeline& pipeline) {
    session.add(frame, pipeline);
    changes.add(frame, pipeline);
    stream.add(frame, pipeline);
  }
};

/// Gives `pipeline` a scan and the readings of the IMU until then, and `recorders` what came of it.
ScanProcess scan_process(
    io::SequenceReader& reader, lio::Pipeline& pipeline, Recorders& recorders) {
  return [&](const Scan& scan) {
    for (const ImuSample& sample : reader.imu_until(pipeline.imu_needed_until(scan.t_end))) {
      pipeline.add_imu(sample);
    }
    lio::FrameResult frame = pipeline.process(scan);
    recorders.add(frame, pipeline);
    return frame;
  };
}

/// Runs `process_scan` on all scans, until `is_enough` after one. Each frame goes to the files and
/// `summary` as it is finished.
Ending process(
    io::SequenceReader& reader,
    const ScanProcess& process_scan,
    const Interruption& interruption,
    RunFiles files,
    RunSummary& summary,
    const std::function<bool(const lio::FrameResult&)>& is_enough) {
  return use_scans(reader, interruption, [&](const Scan& scan) -> std::optional<std::string> {
    const lio::FrameResult frame = process_scan(scan);
    summary.add(frame, scan.points.size());
    files.add(frame);
    return is_enough(frame) ? std::nullopt : std::optional<std::string>(lio::name(frame.status));
  });
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    say("warning: " + warning);
  }
}

/// Returns what has changed, in a line; empty when nothing was watched.
std::string write_changes(
    const std::string& folder,
    const ChangeRecorder& changes,
    const Eigen::Vector3d& origin,
    Ending& ending) {
  std::string line;
  if (changes.is_of_use()) {
    attempt(
        {folder + "/changes.ply"}, ending, [&] { line = changes.write(folder, origin) + "\n"; });
  }
  return line;
}

void print_results(
    const std::string& folder,
    const RunSummary& summary,
    std::size_t map_points,
    double wall_seconds) {
  fmt::print("{}", summary.timing_table());
  fmt::print(
      "{}: {} poses of {} scans, {} map points, {:.1f} s\n",
      folder,
      summary.poses(),
      summary.frames(),
      map_points,
      wall_seconds);
}

/// One way through a recording.
struct Run {
  std::unique_ptr<io::SequenceReader> reader;
  std::unique_ptr<lio::Pipeline> pipeline;
  Eigen::Vector3d origin;  ///< of the map [m]
  io::ResultFolder results;
  RunSummary summary;
};

/// Writes and prints what is left to say of a `run` that took `seconds`.
void finish(
    const RunArguments& arguments, Run& run, Recorders& recorders, Ending ending, double seconds) {
  const std::string input = name_of(arguments.input, run.reader->info());
  const std::string& folder = run.results.path();
  print_notes(run.reader->info());
  warn(run.pipeline->findings());
  const std::size_t map_points = run.pipeline->map().points().size();
  check_useful(run.summary, map_points, ending, input);
  warn(run.summary.warnings());
  attempt({folder + "/timing.json"}, ending, [&] { write_timing(folder, run.summary, seconds); });
  write_map(run.results, run.pipeline->map(), run.origin, ending);
  attempt({recorders.session.path()}, ending, [&] { recorders.session.finish(); });
  const std::string changed = write_changes(folder, recorders.changes, run.origin, ending);
  run.results.publish();
  print_results(arguments.folder, run.summary, map_points, seconds);
  fmt::print("{}", changed);
  check_ending(ending, arguments.folder);
  check_usable(run.summary, map_points, arguments.folder);
}

/// Returns whether to begin again, in which case it leaves no results.
bool run_once(
    const RunArguments& arguments,
    RunOptions& options,
    RunStream& stream,
    SecondStart& second_start) {
  auto reader = open_input(arguments.input, options.input);
  check_apart(name_of(arguments.input, reader->info()), arguments.folder);
  auto pipeline = make_pipeline(arguments.prior, options, reader->info());
  const Eigen::Vector3d origin = origin_of(arguments.prior);
  const Interruption interruption;
  Run run{
      std::move(reader),
      std::move(pipeline),
      origin,
      io::ResultFolder(arguments.folder),
      RunSummary(options.pipeline.inertial.returns.max_count)};
  announce_unfinished(run.results);
  const auto begin = std::chrono::steady_clock::now();
  const std::string& folder = run.results.path();
  const lio::LioMap& map = run.pipeline->map();
  Recorders recorders{SessionRecorder(folder, map), ChangeRecorder(map), stream};
  const Ending ending = process(
      *run.reader,
      scan_process(*run.reader, *run.pipeline, recorders),
      interruption,
      RunFiles(folder, origin),
      run.summary,
      [&](const auto& frame) { return second_start.is_due(*run.pipeline, frame.time); });
  if (is_whole(ending) && second_start.is_due()) {
    warn(run.pipeline->findings());
    return true;
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  finish(arguments, run, recorders, ending, wall.count());
  return false;
}

void run(const RunArguments& arguments, RunOptions& options) {
  check(arguments.prior, arguments.folder);
  RunStream stream(arguments.stream);
  SecondStart second_start(arguments.input, arguments.again);
  while (run_once(arguments, options, stream, second_start)) {
    second_start.begin(options);
  }
}

}  // namespace

void add_run_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("run", "Estimate the trajectory and the two-sided map of a sequence");
  const auto arguments = std::make_shared<RunArguments>();
  command->add_option(
      "INPUT",
      arguments->input,
      "Folder of PCD, PLY or KITTI .bin scans, nvm sequence folder, or ROS 1 bag");
  command->add_option("--out", arguments->folder, "Folder of the results");
  command->add_option(
      "--stream", arguments->stream, "File or pipe for a viewer: scans and map as the run goes on");
  command->add_option("--again", arguments->again)->group("");  // of who fills a pipe: SecondStart
  add_prior_options(*command, arguments->prior);
  add_run_options(*command, arguments->options);
  command->callback([arguments] {
    std::optional<RunOptions> options = read_run_options(arguments->options);
    if (!options) {
      return;
    }
    if (arguments->input.empty() || arguments->folder.empty()) {
      throw CLI::RequiredError("each of INPUT and --out");
    }
    run(*arguments, *options);
  });
}

}  // namespace nvm::app
