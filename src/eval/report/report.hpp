// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "eval/report/evaluation.hpp"

namespace nvm::eval {

/// Writes evaluation.json and drawing.json into `folder`, which is made where it does not exist;
/// the Python package draws them (python/nvm/report). `evaluation` has at least one run. Each file
/// appears whole or not at all. Throws std::runtime_error, naming the file, when one cannot be
/// written.
void write_report(const Evaluation& evaluation, const std::string& folder);

}  // namespace nvm::eval
