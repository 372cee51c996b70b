// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/outline.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace nvm::lio {

namespace {

constexpr double kStep = 0.1;  // of heights [m]

using Histogram = std::map<int, double>;

Histogram counted(const std::vector<double>& heights) {
  Histogram counts;
  for (const double height : heights) {
    counts[static_cast<int>(std::lround(height / kStep))] += 1.0;
  }
  return counts;
}

/// Adds to `scores` how much of `map` and `scan` meets for each shift of the scan. Roots, so that a
/// floor that was seen well does not outvote a ceiling.
void correlate(const std::vector<double>& map, const std::vector<double>& scan, Histogram& scores) {
  const Histogram theirs = counted(map);
  for (const auto& [height, points] : counted(scan)) {
    for (const auto& [map_height, map_points] : theirs) {
      for (const int blur : {-1, 0, 1}) {
        scores[map_height - height + blur] += std::sqrt(points * map_points);
      }
    }
  }
}

std::uint64_t facing_cell_of(const Eigen::Vector3d& point, double facing) {
  constexpr std::uint64_t kMask = (1U << 20) - 1;
  constexpr double kSector = 0.8;  // [rad]
  std::uint64_t cell = static_cast<std::uint64_t>(std::llround(facing / kSector)) & 15U;
  for (const double coordinate : point) {
    const auto index = static_cast<std::int64_t>(std::floor(coordinate / WallGrid::kCell));
    cell = (cell << 20) | (static_cast<std::uint64_t>(index) & kMask);
  }
  return cell;
}

}  // namespace

void Outline::add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  constexpr double kLevel = 0.9;
  constexpr double kUpright = 0.3;
  if (normal.z() > kLevel) {
    floors_.push_back(point.z());
  } else if (normal.z() < -kLevel) {
    ceilings_.push_back(point.z());
  } else if (std::abs(normal.z()) < kUpright && !normal.isZero()) {
    const double facing = std::atan2(normal.y(), normal.x());
    if (cells_.insert(facing_cell_of(point, facing)).second) {
      walls_.push_back({{point.head<2>(), facing}, point.z()});
    }
  }
}

std::vector<double> Outline::heights_of(const Outline& scan, std::size_t count) const {
  constexpr int kApart = 4;            // steps between two that are not the same
  constexpr double kWorthALook = 0.4;  // of the best
  Histogram scores;
  correlate(floors_, scan.floors_, scores);
  correlate(ceilings_, scan.ceilings_, scores);
  std::vector<std::pair<double, int>> ranked;
  for (const auto& [shift, score] : scores) {
    ranked.emplace_back(score, shift);
  }
  std::sort(ranked.rbegin(), ranked.rend());
  std::vector<int> chosen;
  for (const auto& [score, shift] : ranked) {
    const bool is_new = std::none_of(chosen.begin(), chosen.end(), [&, place = shift](int other) {
      return std::abs(place - other) < kApart;
    });
    if (chosen.size() < count && score >= kWorthALook * ranked.front().first && is_new) {
      chosen.push_back(shift);
    }
  }
  std::vector<double> heights;
  std::transform(chosen.begin(), chosen.end(), std::back_inserter(heights), [](int shift) {
    return kStep * shift;
  });
  return heights;
}

WallGrid Outline::grid_for(const Outline& scan, double height) const {
  constexpr double kMargin = 0.2;  // [m]
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const Upright& point : scan.walls_) {
    lowest = std::min(lowest, point.height + height - kMargin);
    highest = std::max(highest, point.height + height + kMargin);
  }
  std::vector<WallPoint> walls;
  for (const Upright& point : walls_) {
    if (point.height >= lowest && point.height <= highest) {
      walls.push_back(point.wall);
    }
  }
  return WallGrid(walls);
}

}  // namespace nvm::lio
