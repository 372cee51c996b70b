// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/prior_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/given_pose.hpp"
#include "app/say.hpp"
#include "io/file/doing.hpp"
#include "io/file/file.hpp"
#include "io/result/map_in.hpp"
#include "io/result/map_origin.hpp"
#include "lio/pipeline/prior_pipeline.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm::app {

namespace {

namespace fs = std::filesystem;

/// Names and values of map options, to be compared.
struct OptionList {
  std::vector<std::pair<std::string, double>> options;

  template <class Value>
  void operator()(const OptionInfo& info, Value value) {
    options.emplace_back(info.name, static_cast<double>(value));
  }
  template <class Enum, class Choices>
  void operator()(const OptionInfo& info, Enum value, const Choices&) {
    options.emplace_back(info.name, static_cast<double>(value));
  }
};

OptionList listed(const MapOptions& options) {
  OptionList list;
  visit_options(options, list);
  return list;
}

/// "voxel_size 0.5 (not 0.3), ...": what the prior map has and the run does not ask for.
std::string differences(const MapOptions& prior, const MapOptions& asked) {
  const OptionList theirs = listed(prior);
  const OptionList ours = listed(asked);
  std::string text;
  for (std::size_t i = 0; i < theirs.options.size(); ++i) {
    const auto& [name, value] = theirs.options[i];
    if (value != ours.options[i].second) {
      text += fmt::format(
          "{}{} {} (not {})", text.empty() ? "" : ", ", name, value, ours.options[i].second);
    }
  }
  return text;
}

std::optional<lio::Start> start_from(
    const std::vector<double>& numbers, const Eigen::Vector3d& origin) {
  if (numbers.empty()) {
    return std::nullopt;
  }
  lio::Start start{given_pose("--start", numbers), numbers.size() == 4};
  start.T_map_body.translation() -= origin;
  return start;
}

}  // namespace

void add_prior_options(CLI::App& command, PriorArguments& arguments) {
  command.add_option(
      "--map",
      arguments.map,
      "Prior map (map.nvm, or the folder of a run) to find the way in; it stays as it is");
  command
      .add_option(
          "--start",
          arguments.start,
          "Where the body is in the prior map when the scans begin: x,y,z [m],yaw [rad], or "
          "x,y,z,qx,qy,qz,qw, to about 1 m and 20 degrees; without it the whole map is searched")
      ->delimiter(',')
      ->allow_extra_args(false)  // else it would take the input that follows
      ->type_name("NUMBERS");
  command.add_flag(
      "--extend", arguments.extends, "Go on mapping in a copy of the prior map, for --out");
}

void check(const PriorArguments& arguments, const std::string& folder) {
  if (arguments.map.empty()) {
    if (arguments.extends || !arguments.start.empty()) {
      throw std::invalid_argument("--start and --extend need the prior map that --map names");
    }
    return;
  }
  start_from(arguments.start, Eigen::Vector3d::Zero());  // refuses bad ones before all else
  std::error_code ignored;
  const fs::path parent = fs::absolute(io::map_in(arguments.map)).parent_path();
  if (fs::equivalent(parent, folder, ignored)) {
    io::fail(
        arguments.map, "would be replaced: it lies in " + folder + "; give --out another folder");
  }
}

Eigen::Vector3d origin_of(const PriorArguments& arguments) {
  return arguments.map.empty() ? Eigen::Vector3d::Zero()
                               : io::read_origin(io::map_in(arguments.map));
}

std::unique_ptr<lio::Pipeline> make_prior_pipeline(
    const PriorArguments& arguments, const lio::PipelineOptions& options) {
  return io::doing("loading " + arguments.map, [&] {
    VoxelMap map = load_map(io::map_in(arguments.map));
    const std::string text = differences(map.options(), options.map);
    if (!text.empty()) {
      say("note: " + arguments.map + " keeps its own options: " + text);
    }
    const std::optional<lio::Start> start = start_from(arguments.start, origin_of(arguments));
    return std::make_unique<lio::PriorPipeline>(options, std::move(map), start, arguments.extends);
  });
}

}  // namespace nvm::app
