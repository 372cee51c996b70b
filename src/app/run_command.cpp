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
#include <vector>

#include "app/doing.hpp"
#include "app/prior_options.hpp"
#include "app/results.hpp"
#include "app/run_files.hpp"
#include "app/run_options.hpp"
#include "app/run_stream.hpp"
#include "app/run_summary.hpp"
#include "app/run_verdict.hpp"
#include "app/say.hpp"
#include "app/session_recorder.hpp"
#include "io/sequence_reader.hpp"
#include "lio/pipeline_options.hpp"

namespace nvm::app {

namespace {

struct RunArguments {
  std::string input;
  std::string folder;
  std::string stream;
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
  return doing(making_map(pipeline.map), [&] { return lio::make_pipeline(pipeline); });
}

using ScanProcess = std::function<lio::FrameResult(const lio::Scan&)>;

/// Gives `pipeline` a scan and the readings of the IMU until then, and `session` and `stream` what
/// came of it.
ScanProcess scan_process(
    io::SequenceReader& reader,
    lio::Pipeline& pipeline,
    SessionRecorder& session,
    RunStream& stream) {
  return [&](const lio::Scan& scan) {
    for (const lio::ImuSample& sample : reader.imu_until(pipeline.imu_needed_until(scan.t_end))) {
      pipeline.add_imu(sample);
    }
    lio::FrameResult frame = pipeline.process(scan);
    session.add(frame, pipeline);
    stream.add(frame, pipeline);
    return frame;
  };
}

/// Runs `process_scan` on all scans. Each frame goes to the files and `summary` as it is finished.
Ending process(
    io::SequenceReader& reader,
    const ScanProcess& process_scan,
    const Interruption& interruption,
    RunFiles files,
    RunSummary& summary) {
  return use_scans(reader, interruption, [&](const lio::Scan& scan) {
    const lio::FrameResult frame = process_scan(scan);
    summary.add(frame, scan.points.size());
    files.add(frame);
    return lio::name(frame.status);
  });
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    say("warning: " + warning);
  }
}

void run(const RunArguments& arguments, RunOptions& options) {
  check(arguments.prior, arguments.folder);
  check_apart(arguments.input, arguments.folder);
  const auto reader = open_input(arguments.input, options.input);
  const auto pipeline = make_pipeline(arguments.prior, options, reader->info());
  const Eigen::Vector3d origin = origin_of(arguments.prior);
  const Interruption interruption;
  RunStream stream(arguments.stream);
  io::ResultFolder results(arguments.folder);
  announce_unfinished(results);
  const auto begin = std::chrono::steady_clock::now();
  RunSummary summary(options.pipeline.inertial.returns.max_count);
  SessionRecorder session(results.path(), pipeline->map());
  Ending ending = process(
      *reader,
      scan_process(*reader, *pipeline, session, stream),
      interruption,
      RunFiles(results.path(), origin),
      summary);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  print_notes(reader->info());
  warn(pipeline->findings());
  const std::size_t map_points = pipeline->map().points().size();
  check_useful(summary, map_points, ending, arguments.input);
  warn(summary.warnings());
  attempt({results.path() + "/timing.json"}, ending, [&] {
    write_timing(results.path(), summary, wall.count());
  });
  write_map(results, pipeline->map(), origin, ending);
  attempt({session.path()}, ending, [&] { session.finish(); });
  results.publish();
  fmt::print("{}", summary.timing_table());
  fmt::print(
      "{}: {} poses of {} scans, {} map points, {:.1f} s\n",
      arguments.folder,
      summary.poses(),
      summary.frames(),
      map_points,
      wall.count());
  check_ending(ending, arguments.folder);
  check_usable(summary, map_points, arguments.folder);
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
