// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace nvm::eval {

/// Summary of a set of errors, all of them >= 0, in the unit of the errors.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  ///< of an even count the mean of the two in the middle
  double max = 0.0;
};

/// The statistics of `errors`; nothing for an empty set.
std::optional<ErrorStatistics> summarize(std::vector<double> errors);

}  // namespace nvm::eval
