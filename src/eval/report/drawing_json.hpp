// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "eval/report/evaluation.hpp"

namespace nvm::eval {

/// What pictures of `evaluation` show, as JSON: paths and walls from above, errors over time, and
/// the points of each wall seen along it; docs/evaluation.md says what its members mean.
std::string drawing_json(const Evaluation& evaluation);

}  // namespace nvm::eval
