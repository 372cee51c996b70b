// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <algorithm>
#include <cstddef>

namespace nvm::lio {

/// Mean of values that are not equally sure, and how much they differ.
class WeightedMean {
 public:
  /// `weight` is positive, such as the inverse of a variance.
  void add(double value, double weight) {
    ++count_;
    weight_ += weight;
    sum_ += weight * value;
    sum_squares_ += weight * value * value;
  }

  std::size_t count() const { return count_; }
  double weight() const { return weight_; }  ///< of all values
  /// Of at least one value.
  double mean() const { return sum_ / weight_; }
  /// Weighted mean of their squared differences from the mean; of at least one value.
  double variance() const { return std::max(0.0, sum_squares_ / weight_ - mean() * mean()); }

 private:
  std::size_t count_ = 0;
  double weight_ = 0.0;
  double sum_ = 0.0, sum_squares_ = 0.0;  // weighted
};

}  // namespace nvm::lio
