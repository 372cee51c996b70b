// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "app/insert_totals.hpp"

#include <fmt/format.h>

namespace nvm::app {

void InsertTotals::add(std::size_t more_points, const InsertStats& more) {
  constexpr std::size_t InsertStats::*kCounters[] = {
      &InsertStats::stored,
      &InsertStats::too_close,
      &InsertStats::surface_full,
      &InsertStats::no_normal,
      &InsertStats::non_finite,
      &InsertStats::out_of_range,
      &InsertStats::map_full,
      &InsertStats::new_voxels,
      &InsertStats::evicted_voxels,
      &InsertStats::evicted_points};
  points += more_points;
  for (const auto counter : kCounters) {
    stats.*counter += more.*counter;
  }
}

std::string InsertTotals::why_empty() const {
  if (points == 0) {
    return "no return lies between lidar.min_range and lidar.max_range; are coordinates in metres?";
  }
  if (stats.out_of_range > stats.no_normal) {
    return fmt::format(
        "{} of {} returns lie more than 2^20 voxels from the origin; are coordinates in "
        "millimetres, or those of a country's grid?",
        stats.out_of_range,
        points);
  }
  if (stats.map_full > 0) {
    return "map.max_bytes is too small for a single scan";
  }
  return fmt::format(
      "all {} returns lie on no surface; when scans are that sparse, normals.min_radius and "
      "normals.max_radius must be larger; or are coordinates not in metres?",
      points);
}

}  // namespace nvm::app
