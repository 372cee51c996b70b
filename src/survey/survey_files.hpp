// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "survey/survey.hpp"

namespace nvm::survey {

/// Writes walls.json, walls.csv, plan.svg, plan.dxf, walls.html and faces.obj to the folder
/// `folder`, which is made, all of them or none; the plan at `plan_height` [m] above the floor.
/// Throws std::runtime_error.
void write_survey(const Survey& survey, double plan_height, const std::string& folder);

}  // namespace nvm::survey
