// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>

#include "app/results.hpp"
#include "app/run_summary.hpp"

namespace nvm::app {

/// Throws Failure, with the main cause in one line, when a run of `input` gave no trajectory or no
/// map, so that nothing is worth keeping.
void check_useful(
    const RunSummary& summary,
    std::size_t map_points,
    const Ending& ending,
    const std::string& input);

/// Throws Failure with kExitUnusable when fewer than half of the frames are usable, or the map has
/// fewer points than there are poses.
void check_usable(const RunSummary& summary, std::size_t map_points, const std::string& folder);

}  // namespace nvm::app
