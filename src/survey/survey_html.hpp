// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "survey/survey.hpp"

namespace nvm::survey {

/// A page with the plan `svg` and the table of `survey`, which needs nothing from elsewhere: a row
/// that the pointer is on shows its wall in the plan.
std::string survey_html(const Survey& survey, const std::string& svg);

}  // namespace nvm::survey
