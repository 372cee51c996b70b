// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/scan_thinning.hpp"

#include <algorithm>
#include <vector>

namespace nvm::lio {

namespace {

// A sample tells the distribution of ranges well enough. Prime: a LiDAR fires its lines in turn.
constexpr std::size_t kStride = 17;

std::vector<float> sample_of_sq_ranges(const Scan& scan, const ReturnLimits& limits) {
  std::vector<float> sq_ranges;
  sq_ranges.reserve(scan.points.size() / kStride + 1);
  for (std::size_t i = 0; i < scan.points.size(); i += kStride) {
    const float sq_range = scan.points[i].sq_range();
    if (limits.contain(sq_range)) {
      sq_ranges.push_back(sq_range);
    }
  }
  return sq_ranges;
}

/// The Q for which the sum of min(1, q / Q) over `sq_ranges` is `wanted`, less than all.
float find_sq_reach(std::vector<float> sq_ranges, double wanted) {
  std::sort(sq_ranges.begin(), sq_ranges.end());
  double sum = 0.0;  // of those within reach
  for (std::size_t i = 0; i < sq_ranges.size(); ++i) {
    sum += static_cast<double>(sq_ranges[i]);
    const auto beyond = static_cast<double>(sq_ranges.size() - i - 1);
    const double sq_reach = sum / (wanted - beyond);
    const bool is_next_beyond =
        i + 1 == sq_ranges.size() || sq_reach <= static_cast<double>(sq_ranges[i + 1]);
    if (wanted > beyond && is_next_beyond) {
      return static_cast<float>(sq_reach);
    }
  }
  return 0.0F;
}

}  // namespace

ScanThinning::ScanThinning(const Scan& scan, const ReturnLimits& limits) {
  if (scan.points.size() > limits.max_count) {
    const double wanted = static_cast<double>(limits.max_count) / static_cast<double>(kStride);
    sq_reach_ = find_sq_reach(sample_of_sq_ranges(scan, limits), wanted);
  }
}

}  // namespace nvm::lio
