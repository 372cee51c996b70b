// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace nvm::app {

/// Refuses arguments that are no number from `min` to `max`; CLI::Range lets not-a-number pass.
inline CLI::Validator number_between(double min, double max) {
  const std::string range = fmt::format("{:g} to {:g}", min, max);
  const auto check = [min, max, range](const std::string& text) {
    double value = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    return is_number && value >= min && value <= max
               ? std::string()
               : fmt::format("{} must be a number from {}", text, range);
  };
  return {check, range};
}

}  // namespace nvm::app
