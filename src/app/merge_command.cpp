// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/merge_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/given_pose.hpp"
#include "app/interruption.hpp"
#include "app/results.hpp"
#include "io/file/doing.hpp"
#include "io/file/file.hpp"
#include "io/file/pending_files.hpp"
#include "io/result/map_files.hpp"
#include "io/result/map_origin.hpp"
#include "lio/map/lio_map.hpp"
#include "merge/merge.hpp"

namespace nvm::app {

namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> folders;
  std::string out;
  std::vector<std::string> guesses;  ///< as given_pose() takes them, with commas
  int threads = 1;
};

Pose guess_from(const std::string& text) {
  const std::string option = "--guess " + text;
  std::vector<double> numbers;
  for (const std::string& word : CLI::detail::split(text, ',')) {
    numbers.push_back(0.0);
    if (!CLI::detail::lexical_cast(word, numbers.back())) {
      throw std::invalid_argument(option + ": " + io::quote(word) + " must be a number");
    }
  }
  return given_pose(option, numbers);
}

/// Throws before the long work what would be found after it.
void check(const MergeArguments& arguments) {
  if (fs::path(arguments.out).extension() != ".nvm") {
    throw std::invalid_argument("--out " + arguments.out + ": must be the name of a .nvm file");
  }
  if (arguments.folders.size() < 2) {
    throw std::invalid_argument(
        "merging needs the results of two runs or more: name their folders");
  }
  if (arguments.guesses.size() >= arguments.folders.size()) {
    throw std::invalid_argument(fmt::format(
        "--guess was given {} times: it may be once for each folder after the first",
        arguments.guesses.size()));
  }
  for (const std::string& folder : arguments.folders) {
    std::error_code ignored;
    if (fs::equivalent(arguments.out, folder + "/map.nvm", ignored)) {
      io::fail(arguments.out, "is the map of " + folder + ": give --out another name");
    }
  }
  io::read_origin(arguments.out);  // which may be damaged
  remove_leftovers(arguments.out);
  const io::PendingFiles can_be_written(arguments.out);
}

/// Says where a run lies, as --guess takes it, and how well it fits.
void print_fit(
    const std::string& folder, const merge::SessionFit& fit, const Eigen::Vector3d& origin) {
  const Eigen::Vector3d p = fit.T_map_session.translation() + origin;
  const Eigen::Matrix3d R = fit.T_map_session.linear();
  fmt::print(
      "{}: at {:.3f} {:.3f} {:.3f} m, yaw {:.5f} rad; shares {:.0f} % of its surface, {} of {} "
      "keyframes; off by {:.1f} mm (RMS)\n",
      folder,
      p.x(),
      p.y(),
      p.z(),
      std::atan2(R(1, 0), R(0, 0)),
      100.0 * fit.overlap,
      fit.shared_keyframes,
      fit.keyframes,
      1000.0 * fit.rms);
}

void write(const lio::LioMap& map, const Eigen::Vector3d& origin, const std::string& out) {
  io::PendingFiles files(out);
  io::write_map_files(map, origin, fs::path(files.temporary()).replace_extension("").string());
  io::write_origin_unless_told(out, origin, files.temporary());
  files.commit();
}

void merge_folders(const MergeArguments& arguments) {
  std::vector<Pose> guesses;
  for (const std::string& guess : arguments.guesses) {
    guesses.push_back(guess_from(guess));
  }
  const Executor executor(arguments.threads);
  io::doing("making way for " + arguments.out, [&] { check(arguments); });
  const std::vector<merge::Session> sessions =
      io::doing("loading the runs", [&] { return merge::read_sessions(arguments.folders); });
  merge::Merged merged =
      io::doing("merging", [&] { return merge::merge_sessions(sessions, guesses, executor); });
  const Interruption interruption;
  const Eigen::Vector3d& origin = sessions.front().origin;
  const auto map = lio::continued_map(std::move(merged.map), true);
  io::doing("writing " + arguments.out, [&] { write(*map, origin, arguments.out); });
  for (std::size_t i = 1; i < sessions.size(); ++i) {
    print_fit(sessions[i].name, merged.fits[i], origin);
  }
  fmt::print("{}: {} map points\n", arguments.out, map->points().size());
  interruption.check(arguments.out + " is whole");
}

}  // namespace

void add_merge_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("merge", "Put the maps of several runs of one place together");
  const auto arguments = std::make_shared<MergeArguments>();
  command
      ->add_option(
          "RESULTS", arguments->folders, "Folders of nvm run; the first one's frame is kept")
      ->required();
  command
      ->add_option(
          "--out",
          arguments->out,
          "The merged map, a .nvm file; its points appear beside it as .ply")
      ->required();
  command
      ->add_option(
          "--guess",
          arguments->guesses,
          "Where the second run's map begins in the first run's frame: x,y,z [m],yaw [rad], or "
          "x,y,z,qx,qy,qz,qw, to about 1 m and 5 degrees where they overlap; again for the third; "
          "else places are searched for")
      ->allow_extra_args(false)  // else it would take the folders that follow
      ->type_name("NUMBERS");
  command->add_option("--threads", arguments->threads, "1 to 256")->capture_default_str();
  command->callback([arguments] { merge_folders(*arguments); });
}

}  // namespace nvm::app
