// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/evaluate_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/interruption.hpp"
#include "app/number_between.hpp"
#include "app/say.hpp"
#include "eval/report/evaluation.hpp"
#include "eval/report/report.hpp"
#include "eval/walls/region.hpp"
#include "io/file/doing.hpp"

namespace nvm::app {
namespace {

constexpr double kMillimetres = 1e3;

struct EvaluateArguments {
  std::vector<std::string> runs;
  std::string truth;
  std::string folder;
  std::string alignment = "se3";
  std::string regions;
  double time_offset = 0.0;
  eval::EvaluationOptions options;
};

/// Makes the names of runs in folders of the same name differ: nvm, nvm (2), ...
void number_equal_names(std::vector<eval::RunEvaluation>& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    int count = 1;
    for (std::size_t j = i + 1; j < runs.size(); ++j) {
      if (runs[j].name == runs[i].name) {
        runs[j].name += fmt::format(" ({})", ++count);
      }
    }
  }
}

/// ", 91 poses over 9.0 of 10.0 s", and how far from true they are.
std::string trajectory_summary(const eval::TrajectoryEvaluation& trajectory) {
  return fmt::format(
      ", ATE RMSE {:.2f} mm over {} poses and {:.1f} of {:.1f} s",
      kMillimetres * trajectory.absolute.rmse,
      trajectory.association.pairs.size(),
      trajectory.seconds,
      trajectory.truth_seconds);
}

std::string map_summary(const eval::MapEvaluation& map) {
  std::string text;
  const eval::WallSummary walls = eval::summarize(map.walls);
  if (walls.seen > 0) {
    text += fmt::format(", {} of {} walls", walls.measured, walls.seen);
  }
  if (walls.absolute_error) {
    text += fmt::format(
        ", thickness off by {:.2f} mm (worst {:.2f})",
        kMillimetres * walls.absolute_error->mean,
        kMillimetres * walls.absolute_error->max);
  }
  return text + fmt::format(", {} map points", map.points);
}

void print_summary(const eval::RunEvaluation& run) {
  const std::string text = (run.trajectory ? trajectory_summary(*run.trajectory) : "") +
                           (run.has_map ? map_summary(run.map) : "");
  fmt::print("{}: {}\n", run.name, text.substr(2));
}

void print_remarks(const eval::RunEvaluation& run) {
  constexpr double kUsualGap = 0.25;  // [s]
  if (run.trajectory && run.trajectory->association.max_gap > kUsualGap) {
    say(fmt::format(
        "note: {}: the {} is interpolated over up to {:.2f} s, which adds to its errors",
        run.name,
        run.trajectory->association.interpolates_estimate ? "estimate" : "truth",
        run.trajectory->association.max_gap));
  }
}

void evaluate(EvaluateArguments& arguments) {
  arguments.options.alignment = eval::alignment_kind(arguments.alignment);
  eval::Evaluation evaluation;
  if (!arguments.truth.empty()) {
    evaluation.truth = eval::read_truth(arguments.truth, arguments.time_offset);
  }
  if (!arguments.regions.empty()) {
    arguments.options.regions = eval::read_regions(arguments.regions);
  }
  for (const std::string& run : arguments.runs) {
    evaluation.runs.push_back(io::doing("evaluating " + run, [&] {
      return eval::evaluate_run(run, evaluation.truth, arguments.options);
    }));
  }
  number_equal_names(evaluation.runs);
  const Interruption interruption;
  eval::write_report(evaluation, arguments.folder);
  for (const eval::RunEvaluation& run : evaluation.runs) {
    print_remarks(run);
    print_summary(run);
  }
  fmt::print("{}/evaluation.json\n", arguments.folder);
  interruption.check(arguments.folder + " holds the whole report");
}

}  // namespace

void add_evaluate_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("evaluate", "Compare trajectories and maps of runs with the truth");
  const auto arguments = std::make_shared<EvaluateArguments>();
  command
      ->add_option(
          "RUN_DIR", arguments->runs, "Folders with trajectory.tum and map.ply, or TUM files")
      ->required();
  command->add_option(
      "--truth",
      arguments->truth,
      "Sequence folder (groundtruth.tum, scene.json), or a TUM file; without: only regions and "
      "crispness");
  command->add_option("--out", arguments->folder, "Folder of the report")->required();
  command->add_option("--align", arguments->alignment, "Alignment of trajectories")
      ->check(CLI::IsMember({"se3", "sim3", "none"}))
      ->capture_default_str();
  command->add_option("--regions", arguments->regions, "YAML file of boxes around walls");
  command
      ->add_option("--time-offset", arguments->time_offset, "Added to the times of the truth [s]")
      ->check(number_between(-1e12, 1e12));
  command
      ->add_option(
          "--max-gap",
          arguments->options.max_gap,
          "Poses farther apart are not interpolated [s]; default: 0.25, or 1.5 usual steps up to "
          "1.5")
      ->check(number_between(0.0, 1e6));
  command
      ->add_option(
          "--margin", arguments->options.walls.points.margin, "Kept from the edges of walls [m]")
      ->check(number_between(0.0, 10.0))
      ->capture_default_str();
  command->callback([arguments] { evaluate(*arguments); });
}

}  // namespace nvm::app
