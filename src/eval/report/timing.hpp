// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

namespace nvm::eval {

/// CPU time per scan of one stage of a run (spec §6).
struct StageTiming {
  std::string stage;  ///< as in the file: "map_update_ms", "total_ms", ...
  double mean_ms = 0.0;
  double max_ms = 0.0;
};

/// The stages in a run's timing.json, in the file's order; none when there is no such file. Throws
/// std::runtime_error, naming the file, when it is malformed.
std::vector<StageTiming> read_timing(const std::string& path);

}  // namespace nvm::eval
