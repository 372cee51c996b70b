// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>

#include "lio/pipeline/pipeline.hpp"

namespace nvm::app {

/// A line of the timing table, and a key of timing.json.
struct Stage {
  const char* name;
  const char* key;
  double (*time)(const lio::StageTimes&);  ///< [ms]
};

/// The stages of the paper's timing table (spec §6) and those that they consist of.
const std::array<Stage, 7>& stages();

}  // namespace nvm::app
