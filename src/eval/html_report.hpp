// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "eval/evaluation.hpp"
#include "eval/wall_pictures.hpp"

namespace nvm::eval {

/// The evaluation as one HTML page that needs nothing from elsewhere: tables with a column for each
/// run, the charts, and `pictures`.
std::string html_report(const Evaluation& evaluation, const std::vector<WallPicture>& pictures);

}  // namespace nvm::eval
