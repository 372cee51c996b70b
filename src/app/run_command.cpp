// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/map_files.hpp"
#include "app/progress_bar.hpp"
#include "app/run_files.hpp"
#include "app/run_options.hpp"
#include "app/run_summary.hpp"
#include "io/file.hpp"
#include "io/sequence_reader.hpp"
#include "lio/pipeline_options.hpp"

namespace nvm::app {

namespace {

struct RunArguments {
  std::string input;
  std::string folder;
  RunOptionArguments options;
};

std::unique_ptr<lio::Pipeline> make_pipeline(RunOptions& options, const io::SequenceInfo& info) {
  lio::PipelineOptions& pipeline = options.pipeline;
  pipeline.type = lio::resolve(pipeline.type, info.has_imu);
  pipeline.inertial.T_imu_lidar = lidar_extrinsic(options, info);
  return lio::make_pipeline(pipeline);
}

/// Runs `pipeline` on all scans. Each frame goes to `files` and `summary` as it is finished.
void process(
    io::SequenceReader& reader, lio::Pipeline& pipeline, RunFiles& files, RunSummary& summary) {
  ProgressBar progress(reader.info().scan_count);
  while (const std::optional<lio::Scan> scan = reader.next_scan()) {
    for (const lio::ImuSample& sample : reader.imu_until(scan->t_end)) {
      pipeline.add_imu(sample);
    }
    const lio::FrameResult frame = pipeline.process(*scan);
    progress.step(lio::name(frame.status));
    files.add(frame);
    summary.add(frame);
  }
}

void run(const RunArguments& arguments) {
  std::optional<RunOptions> options = read_run_options(arguments.options);
  if (!options) {
    return;
  }
  if (arguments.input.empty() || arguments.folder.empty()) {
    throw CLI::RequiredError("each of INPUT and --out");
  }
  const auto reader = io::open_sequence(arguments.input, options->input);
  const auto pipeline = make_pipeline(*options, reader->info());
  make_output_folder(arguments.folder);
  const auto begin = std::chrono::steady_clock::now();
  RunFiles files(arguments.folder);
  RunSummary summary;
  process(*reader, *pipeline, files, summary);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  for (const std::string& note : reader->info().notes) {
    fmt::print(stderr, "nvm: note: {}\n", note);
  }
  for (const std::string& warning : summary.warnings()) {
    fmt::print(stderr, "nvm: warning: {}\n", warning);
  }
  if (summary.poses() == 0) {
    io::fail(arguments.input, "no scan got a pose");
  }
  write_map_files(pipeline->map(), arguments.folder);
  files.finish(summary, wall.count());
  fmt::print("{}", summary.timing_table());
  fmt::print(
      "{}: {} poses of {} scans, {} map points, {:.1f} s\n",
      arguments.folder,
      summary.poses(),
      summary.frames(),
      pipeline->map().size(),
      wall.count());
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
  add_run_options(*command, arguments->options);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nvm::app
