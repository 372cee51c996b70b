// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>

#include "lio/map/lio_map.hpp"
#include "lio/match/unobserved_directions.hpp"
#include "lio/scan/prepared_scan.hpp"
#include "lio/state/error_state_filter.hpp"

namespace nvm::lio {

/// How a scan was matched to the map.
struct MatchResult {
  bool accepted = false;        ///< false: too little fits, the filter keeps its prediction
  std::size_t residuals = 0;    ///< keypoints that found a plane
  double inlier_share = 0.0;    ///< of the keypoints, 0 to 1
  double residual_share = 1.0;  ///< of the residuals that fit, 0 to 1
  double residual_rms = 0.0;    ///< [m]
  UnobservedDirections unobserved;
  int iterations = 0;
};

/// Estimates the pose of a scan in the map: the part in which the pipelines differ.
class ScanMatcher {
 public:
  virtual ~ScanMatcher() = default;

  /// `filter` holds the state predicted to the scan's end, with which `scan` was deskewed. Corrects
  /// it, and moves the points of `scan` to where the corrected motion puts them.
  virtual MatchResult match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) = 0;
};

}  // namespace nvm::lio
