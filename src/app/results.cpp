// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/results.hpp"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <optional>
#include <system_error>

#include "app/failure.hpp"
#include "app/progress_bar.hpp"
#include "app/say.hpp"
#include "io/file/doing.hpp"
#include "io/file/file.hpp"
#include "io/file/pending_path.hpp"
#include "io/result/map_files.hpp"
#include "io/result/map_origin.hpp"

namespace nvm::app {

namespace {

namespace fs = std::filesystem;

}  // namespace

void check_apart(const std::string& input, const std::string& folder) {
  std::error_code ignored;
  for (const char* below : {"", "/scans", "/velodyne"}) {
    if (fs::equivalent(input + below, folder, ignored)) {
      io::fail(
          folder, "is where the scans are; give --out another folder, as in " + folder + "/out");
    }
  }
}

void announce_unfinished(const io::ResultFolder& results) {
  for (const std::string& path : results.unfinished()) {
    say("note: " + path + ": was left by a run that was killed; it goes when this one is complete");
  }
}

void remove_leftovers(const std::string& path) {
  for (const std::string& left : io::leftovers_of(path)) {
    say("note: " + left + ": was left by a program that was killed; removed");
    fs::remove_all(left);
  }
}

void print_notes(const io::SequenceInfo& info) {
  for (const std::string& note : info.notes) {
    say("note: " + note);
  }
}

Ending use_scans(
    io::SequenceReader& reader,
    const Interruption& interruption,
    const std::function<std::optional<std::string>(const Scan&)>& use) {
  Ending ending;
  ProgressBar progress(reader.info().scan_count);
  std::size_t scans = 0;
  try {
    while (interruption.signal() == 0) {
      const bool goes_on = io::doing(fmt::format("working on scan {}", ++scans), [&] {
        const std::optional<Scan> scan = reader.next_scan();
        const std::optional<std::string> shown = scan ? use(*scan) : std::nullopt;
        if (shown) {
          progress.step(*shown);
        }
        return shown.has_value();
      });
      if (!goes_on) {
        return ending;
      }
    }
    ending.signal = interruption.signal();
  } catch (const std::exception& error) {
    ending.error = error.what();
  }
  return ending;
}

void attempt(
    const std::vector<std::string>& files, Ending& ending, const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    ending.error += (ending.error.empty() ? "" : "; ") + std::string(error.what());
    for (const std::string& file : files) {
      std::error_code ignored;
      fs::remove(file, ignored);
    }
  }
}

void write_map(
    const io::ResultFolder& results,
    const lio::LioMap& map,
    const Eigen::Vector3d& origin,
    Ending& ending) {
  if (map.is_frozen()) {
    return;
  }
  const std::string stem = results.path() + "/map";
  attempt({stem + ".ply", stem + ".nvm"}, ending, [&] {
    io::doing("writing the map", [&] {
      io::write_map_files(map, origin, stem);
      if (!origin.isZero(0.0)) {
        io::write_origin(stem + ".nvm", origin);
      }
    });
  });
}

void check_ending(const Ending& ending, const std::string& folder) {
  if (!ending.error.empty()) {
    throw Failure(
        fmt::format("{} (what could be saved is in {})", ending.error, folder), kExitError);
  }
  if (ending.signal != 0) {
    throw Failure(
        fmt::format("interrupted: {} holds whole results of the scans until then", folder),
        kExitSignal + ending.signal);
  }
}

}  // namespace nvm::app
