// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/match/faint_direction.hpp"

#include "common/printed.hpp"
#include "lio/match/degeneracy.hpp"

namespace nvm::lio {

namespace {

// Of the information. On worlds of two simulators, scans with more, at 3 to 4 %, were followed to 4
// to 7 mm by LiDAR alone; with 0.3 to 0.9 % the poses erred by 15 to 290 mm, nearly all along it.
constexpr double kFaint = 0.01;
constexpr std::size_t kMinScans = 10;

}  // namespace

void FaintDirection::add(
    const AlignResult& aligned, double mean_range, const Eigen::Matrix3d& R_body_scan) {
  ++scans_;
  if (aligned.observability[0] >= kFaint) {
    return;
  }
  ++faint_;
  sum_shares_ += aligned.observability[0];
  const UnobservedDirections faintest = faintest_directions(aligned, 1, mean_range, R_body_scan);
  along_.add(faintest.translations);
  about_.add(faintest.rotations);
}

std::string FaintDirection::finding() const {
  if (scans_ < kMinScans || 2 * faint_ <= scans_) {
    return "";
  }
  std::string where;
  if (const auto axis = along_.axis()) {
    where += " along " + axis_text(*axis);
  }
  if (const auto axis = about_.axis()) {
    where += (where.empty() ? " about " : " and about ") + axis_text(*axis);
  }
  return printed(
      "in %zu of %zu scans little tells the pose%s (%.1f %% of what the scan tells, and %.0f %% is "
      "little): it errs by centimetres or more there; give an IMU, or turn or raise the LiDAR so "
      "that it sees surfaces that face that way",
      faint_,
      scans_,
      where.c_str(),
      100.0 * sum_shares_ / static_cast<double>(faint_),
      100.0 * kFaint);
}

}  // namespace nvm::lio
