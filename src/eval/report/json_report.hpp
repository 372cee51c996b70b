// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "eval/report/evaluation.hpp"

namespace nvm::eval {

/// The evaluation as JSON, described in docs/evaluation.md: every number but the points that are
/// drawn. What could not be measured is null.
std::string json_report(const Evaluation& evaluation);

}  // namespace nvm::eval
