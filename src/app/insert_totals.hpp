// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>

#include "nvm/map/insert_stats.hpp"

namespace nvm::app {

/// What became of all the points that went to a map.
struct InsertTotals {
  std::size_t points = 0;  ///< returns within the limits of range
  InsertStats stats;

  void add(std::size_t more_points, const InsertStats& more);

  /// Why the map has none of the points: the main cause and its remedy.
  std::string why_empty() const;
};

}  // namespace nvm::app
