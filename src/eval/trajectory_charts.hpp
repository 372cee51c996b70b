// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>

#include "eval/evaluation.hpp"

namespace nvm::eval {

/// The colour of run `index` in all charts and tables.
std::string run_color(std::size_t index);

/// True and aligned estimated trajectories and the true walls from above, as an <svg> element.
std::string trajectory_chart(const Evaluation& evaluation);

/// The position error of each run over time, as an <svg> element.
std::string error_chart(const Evaluation& evaluation);

}  // namespace nvm::eval
