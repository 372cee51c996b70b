// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/trajectory/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/median.hpp"

namespace nvm::eval {

std::optional<ErrorStatistics> summarize(std::vector<double> errors) {
  if (errors.empty()) {
    return std::nullopt;
  }
  const auto count = static_cast<double>(errors.size());
  ErrorStatistics statistics;
  statistics.count = errors.size();
  statistics.rmse =
      std::sqrt(std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0) / count);
  statistics.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  statistics.max = *std::max_element(errors.begin(), errors.end());
  statistics.median = median(std::move(errors));
  return statistics;
}

}  // namespace nvm::eval
