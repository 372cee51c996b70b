// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lio/deskew.hpp"
#include "lio/error_state_filter.hpp"
#include "lio/lio_map.hpp"
#include "lio/unobserved_directions.hpp"

namespace nvm::lio {

/// A deskewed scan on its way into the map.
struct PreparedScan {
  DeskewedScan scan;
  std::vector<Eigen::Vector3f> normals;  ///< unit, scan frame; zero where there is no plane
  std::vector<std::uint32_t> keypoints;  ///< indices of the points to match
};

/// How a scan was matched to the map.
struct MatchResult {
  bool accepted = false;      ///< false: too little fits, the filter keeps its prediction
  std::size_t residuals = 0;  ///< keypoints that found a plane
  double inlier_share = 0.0;  ///< of the keypoints, 0 to 1
  double residual_rms = 0.0;  ///< [m]
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
