// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/sequence/sequence_reader.hpp"
#include "lio/pipeline/pipeline_options.hpp"
#include "nvm/geometry/pose.hpp"

namespace CLI {
class App;
}

namespace nvm::app {

/// Everything that a YAML file or --set can say about a run.
struct RunOptions {
  lio::PipelineOptions pipeline;
  io::SequenceOptions input;
};

/// The command line's part of it, shared by the subcommands that read scans.
struct RunOptionArguments {
  std::string file;
  std::vector<std::string> overrides;
  bool prints_options = false;
};

/// Adds --config, --set and --print-config to `command`.
void add_run_options(CLI::App& command, RunOptionArguments& arguments);

/// The options that `arguments` ask for; prints them and gives nothing with --print-config. Throws
/// std::invalid_argument, naming the key, for a bad one.
std::optional<RunOptions> read_run_options(const RunOptionArguments& arguments);

/// Opens the sequence `input`. Throws std::exception with one line about what is wrong.
std::unique_ptr<io::SequenceReader> open_input(
    const std::string& input, const io::SequenceOptions& options);

/// `input` as messages name it: a pipe by the recording that comes through it.
std::string name_of(const std::string& input, const io::SequenceInfo& info);

/// "making a map ...", with the memory that `options` may need.
std::string making_map(const MapOptions& options);

/// The extrinsic of a run: as configured, else as the sequence tells. Throws std::invalid_argument
/// for numbers that are no pose.
Pose lidar_extrinsic(const RunOptions& options, const io::SequenceInfo& info);

}  // namespace nvm::app
