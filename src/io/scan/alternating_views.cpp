// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/alternating_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "common/median.hpp"

namespace nvm::io {
namespace {

constexpr int kSectors = 24;  // of the azimuth
constexpr int kBands = 3;     // below, level, above

std::size_t direction_of(const TimedPoint& point, float range) {
  constexpr double kTurn = 6.283185307179586;                        // [rad]
  constexpr float kLevel = 0.17F;                                    // sine of the elevation
  const double turned = std::atan2(point.y, point.x) / kTurn + 0.5;  // 0 to 1
  const int sector = std::min(static_cast<int>(turned * kSectors), kSectors - 1);
  const float sine = point.z / range;
  const int band = sine < -kLevel ? 0 : (sine > kLevel ? 2 : 1);
  return static_cast<std::size_t>(band * kSectors + sector);
}

}  // namespace

AlternatingViews::View AlternatingViews::view_of(const Scan& scan) {
  constexpr int kFewest = 5;  // points of a direction
  constexpr std::size_t kDirections = kSectors * kBands;
  std::array<float, kDirections> sums{};
  std::array<int, kDirections> counts{};
  for (const TimedPoint& point : scan.points) {
    const float range = std::sqrt(point.sq_range());
    if (std::isfinite(range) && range > 0.0F) {
      const std::size_t direction = direction_of(point, range);
      sums[direction] += range;
      ++counts[direction];
    }
  }
  View view(kDirections, 0.0F);
  for (std::size_t i = 0; i < kDirections; ++i) {
    view[i] = counts[i] >= kFewest ? sums[i] / static_cast<float>(counts[i]) : 0.0F;
  }
  return view;
}

/// The median share by which ranges differ, 0 to 2; 0 when too little is seen by both.
double AlternatingViews::difference(const View& a, const View& b) {
  constexpr std::size_t kFewest = 8;  // directions
  std::vector<double> shares;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] > 0.0F && b[i] > 0.0F) {
      shares.push_back(2.0 * static_cast<double>(std::abs(a[i] - b[i]) / (a[i] + b[i])));
    }
  }
  return shares.size() < kFewest ? 0.0 : median(std::move(shares));
}

std::string AlternatingViews::learn(const std::vector<Scan>& first) {
  constexpr std::size_t kMinCount = 10;
  constexpr double kMinDifference = 0.1;
  constexpr double kMuchLess = 0.3;
  if (first.size() < kMinCount) {
    return "";
  }
  std::vector<View> views;
  std::transform(first.begin(), first.end(), std::back_inserter(views), view_of);
  std::vector<double> from_last, from_last_but_one;
  for (std::size_t i = 2; i < views.size(); ++i) {
    from_last.push_back(difference(views[i], views[i - 1]));
    from_last_but_one.push_back(difference(views[i], views[i - 2]));
  }
  const double last = median(std::move(from_last));
  const double last_but_one = median(std::move(from_last_but_one));
  is_watched_ = last > kMinDifference && last_but_one < kMuchLess * last;
  kept_ = views[0];
  left_out_ = views[1];
  return is_watched_ ? fmt::format(
                           "clouds look by turns like those of two LiDARs on one topic: ranges "
                           "differ by {:.0f} % from the cloud before, by {:.0f} % from the one "
                           "before that; those like the first are used: record a topic for each",
                           100.0 * last,
                           100.0 * last_but_one)
                     : "";
}

void AlternatingViews::check(const Scan& scan) {
  constexpr double kGone = 1.0;  // what is kept has fallen silent: go on with the others [s]
  if (!is_watched_) {
    return;
  }
  View view = view_of(scan);
  const bool is_other = difference(view, left_out_) < difference(view, kept_);
  if (is_other && std::abs(scan.t_end - kept_time_) < kGone) {
    left_out_ = std::move(view);
    throw std::runtime_error("looks like the clouds of another LiDAR on the topic");
  }
  if (is_other) {
    std::swap(kept_, left_out_);
  }
  kept_ = std::move(view);
  kept_time_ = scan.t_end;
}

}  // namespace nvm::io
