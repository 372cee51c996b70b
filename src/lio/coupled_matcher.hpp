// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lio/executor.hpp"
#include "lio/scan_matcher.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// CT-LIO style, tightly coupled: the residuals of AlignedMatcher, robust and weighted by
/// planarity, are minimised together with the IMU's prediction (what it integrated since the last
/// scan, and the covariance of that), so that each speaks where the other says little.
class CoupledMatcher final : public ScanMatcher {
 public:
  /// `residual_deviation`: of a point from its plane [m], positive, those that share map points
  /// counted as one. Throws std::invalid_argument for bad options.
  CoupledMatcher(const AlignOptions& align, double residual_deviation, const Executor& executor);

  MatchResult match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) override;

 private:
  bool linearize(const LioMap& map, const NavState& state, Information& out);

  ScanAligner<LioMap> aligner_;
  double residual_deviation_;
  Executor executor_;
  MatchResult result_;
  std::vector<Eigen::Vector3f> points_, normals_;
};

}  // namespace nvm::lio
