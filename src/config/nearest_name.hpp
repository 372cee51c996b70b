// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace nvm::config {

/// The candidate with the smallest edit distance from `name`, if that is small enough for a slip of
/// the typist: at most a third of the name's length, or 2. The first of equals.
std::optional<std::string> nearest_name(
    const std::string& name, const std::vector<std::string>& candidates);

}  // namespace nvm::config
