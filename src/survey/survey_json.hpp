// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

#include "survey/survey.hpp"

namespace nvm::survey {

/// `survey` as JSON; docs/walls.md says what its members mean.
std::string survey_json(const Survey& survey);

}  // namespace nvm::survey
