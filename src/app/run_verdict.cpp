// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/run_verdict.hpp"

#include <fmt/format.h>

#include "app/failure.hpp"

namespace nvm::app {

namespace {

std::string why_useless(const RunSummary& summary, const Ending& ending) {
  if (!ending.error.empty()) {
    return ending.error;
  }
  if (summary.frames() == 0) {
    return "has no scans";
  }
  if (summary.poses() == 0) {
    return "no scan got a pose: " + summary.main_trouble();
  }
  return "the map has no points: " + summary.inserted().why_empty();
}

}  // namespace

void check_useful(
    const RunSummary& summary,
    std::size_t map_points,
    const Ending& ending,
    const std::string& input) {
  if (summary.poses() > 0 && map_points > 0) {
    return;
  }
  if (ending.signal != 0) {
    throw Failure("interrupted before there were results", kExitSignal + ending.signal);
  }
  throw Failure(input + ": " + why_useless(summary, ending), kExitError);
}

void check_usable(const RunSummary& summary, std::size_t map_points, const std::string& folder) {
  if (map_points < summary.poses()) {
    throw Failure(
        fmt::format(
            "{}: the map has {} points after {} poses, so that there is next to none",
            folder,
            map_points,
            summary.poses()),
        kExitUnusable);
  }
  if (2 * summary.usable() < summary.frames()) {
    throw Failure(
        fmt::format(
            "{}: most of the run is unusable: of {} scans {} (frames.csv has them all)",
            folder,
            summary.frames(),
            summary.counts()),
        kExitUnusable);
  }
}

}  // namespace nvm::app
