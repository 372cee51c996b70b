// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/say.hpp"
#include "config/schema.hpp"
#include "io/file/doing.hpp"
#include "io/sequence/sequence_options.hpp"
#include "nvm/map/storage/map_capacity.hpp"

namespace nvm::app {

void add_run_options(CLI::App& command, RunOptionArguments& arguments) {
  command.add_option("--config", arguments.file, "YAML file of options")->check(CLI::ExistingFile);
  command.add_option("--set", arguments.overrides, "An option, as in map.voxel_size=0.2")
      ->type_name("KEY=VALUE");
  command.add_flag(
      "--print-config", arguments.prints_options, "Print all options as YAML, and do nothing else");
}

std::optional<RunOptions> read_run_options(const RunOptionArguments& arguments) {
  RunOptions options;
  config::Schema schema;
  lio::bind(schema, options.pipeline);
  io::bind(schema.section("input", "How to read the sequence"), options.input);
  if (!arguments.file.empty()) {
    schema.read_file(arguments.file);
  }
  for (const std::string& assignment : arguments.overrides) {
    schema.set(assignment);
  }
  if (arguments.prints_options) {
    fmt::print("{}", schema.to_yaml());
    return std::nullopt;
  }
  return options;
}

std::unique_ptr<io::SequenceReader> open_input(
    const std::string& input, const io::SequenceOptions& options) {
  return io::doing("opening " + input, [&] { return io::open_sequence(input, options); });
}

std::string name_of(const std::string& input, const io::SequenceInfo& info) {
  return info.recording.empty() ? input : info.recording;
}

std::string making_map(const MapOptions& options) {
  return fmt::format(
      "making a map of map.capacity={} voxels, for which it needs {:.0f} MB",
      options.capacity,
      static_cast<double>(detail::map_capacity(options).bytes()) / io::kBytesPerMegabyte);
}

Pose lidar_extrinsic(const RunOptions& options, const io::SequenceInfo& info) {
  if (options.input.T_imu_lidar.empty() && info.has_imu && !info.has_T_imu_lidar) {
    say("note: the sequence does not tell T_imu_lidar: the identity is assumed; "
        "input.T_imu_lidar sets it");
  }
  return io::extrinsic(options.input, info.T_imu_lidar);
}

}  // namespace nvm::app
