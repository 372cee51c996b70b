// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "survey/plan.hpp"
#include "survey/survey.hpp"

namespace nvm::survey {

/// `plan` of `survey` as an `<svg>` element that stands alone: walls filled, with both faces and
/// the thickness in millimetres; doors and openings; single faces thin.
std::string plan_svg(const Survey& survey, const Plan& plan);

}  // namespace nvm::survey
