// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "survey/survey.hpp"

namespace nvm::survey {

/// The columns that tables of walls have.
std::vector<std::string> table_header();

/// A row for each wall, then for each body, with texts for the columns.
std::vector<std::vector<std::string>> table_rows(const Survey& survey);

/// The table for a screen, columns aligned.
std::string screen_table(const Survey& survey);

/// The same with commas, and the middle, the normals and all digits, for a spreadsheet. Lengths in
/// metres.
std::string survey_csv(const Survey& survey);

}  // namespace nvm::survey
