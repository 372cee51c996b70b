// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/interruption.hpp"
#include "io/result/result_folder.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "lio/map/lio_map.hpp"

namespace nvm::app {

/// Throws std::runtime_error when results in `folder` would lie where the scans of `input` are
/// looked for.
void check_apart(const std::string& input, const std::string& folder);

/// Says what runs that were killed have left, in one line each.
void announce_unfinished(const io::ResultFolder& results);

/// Removes the temporary files and folders that killed programs have left for `path`, and says so.
void remove_leftovers(const std::string& path);

/// Prints what the reader noticed.
void print_notes(const io::SequenceInfo& info);

/// How the scans of a sequence came to their end: all were used unless one of these is set.
struct Ending {
  int signal = 0;     ///< that interrupted the program
  std::string error;  ///< what went wrong
};

inline bool is_whole(const Ending& ending) { return ending.signal == 0 && ending.error.empty(); }

/// Gives all scans to `use`, which returns what the progress bar shows, or nothing to stop. An
/// error or a signal ends it; what came before stays usable.
Ending use_scans(
    io::SequenceReader& reader,
    const Interruption& interruption,
    const std::function<std::optional<std::string>(const Scan&)>& use);

/// Does `action`. What goes wrong is added to the error of `ending`, and `files` are removed then.
void attempt(
    const std::vector<std::string>& files, Ending& ending, const std::function<void()>& action);

/// Writes the map, whose origin is at `origin` [m], to `results` unless it is a prior one that has
/// not changed. A map that cannot be written, or could not be loaded again, is left out: that
/// becomes the error of `ending`.
void write_map(
    const io::ResultFolder& results,
    const lio::LioMap& map,
    const Eigen::Vector3d& origin,
    Ending& ending);

/// Throws Failure, saying that the results in `folder` are whole but not all, when `ending` was
/// untimely.
void check_ending(const Ending& ending, const std::string& folder);

}  // namespace nvm::app
