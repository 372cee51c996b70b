// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/sweep_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/median.hpp"

namespace nvm::io {

std::string SweepOverlap::learn(const std::vector<Scan>& first) {
  constexpr std::size_t kMinCount = 10;
  constexpr double kOverlapping = 0.7;  // of a sweep, between two beginnings; half for two LiDARs
  if (first.size() < kMinCount) {
    return "";
  }
  std::vector<double> lengths;
  for (const Scan& scan : first) {
    lengths.push_back(scan.t_end - scan.t_begin);
  }
  // The mean, because it does not change with stamps that jitter.
  const double interval =
      (first.back().t_begin - first.front().t_begin) / static_cast<double>(first.size() - 1);
  const double length = median(std::move(lengths));
  is_watched_ = interval < kOverlapping * length;
  return is_watched_
             ? fmt::format(
                   "sweeps overlap: they last {:.3f} s and begin {:.3f} s apart, as those of "
                   "two LiDARs on one topic; those that follow one another are used: record "
                   "a topic for each LiDAR",
                   length,
                   interval)
             : "";
}

void SweepOverlap::check(const Scan& scan) {
  constexpr double kJitter = 0.05;  // of a sweep
  const double overlap = kept_until_ - scan.t_begin;
  const double length = scan.t_end - scan.t_begin;
  const bool goes_back = overlap > 2.0 * length;  // a looped bag
  if (is_watched_ && overlap > kJitter * length && !goes_back) {
    throw std::runtime_error(fmt::format("overlaps the cloud before by {:.3f} s", overlap));
  }
  kept_until_ = scan.t_end;
}

}  // namespace nvm::io
