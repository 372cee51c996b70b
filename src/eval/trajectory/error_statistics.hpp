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
  double median = 0.0;  ///< the mean of the middle two of an even count
  double max = 0.0;
};

/// The statistics of `errors`; nothing for an empty set.
std::optional<ErrorStatistics> summarize(std::vector<double> errors);

/// The median of `values`, which must not be empty; the mean of the middle two of an even count.
double median(std::vector<double> values);

}  // namespace nvm::eval
