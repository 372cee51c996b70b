// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/executor.hpp"
#include "lio/match/scan_matcher.hpp"
#include "lio/match/tight_coupling.hpp"
#include "nvm/registration/scan_aligner.hpp"

namespace nvm::lio {

/// CT-LIO style, tightly coupled: the residuals of AlignedMatcher, robust and weighted by
/// planarity, are minimised together with the IMU's prediction (what it integrated since the last
/// scan, and the covariance of that), so that each speaks where the other says little.
class CoupledMatcher final : public ScanMatcher {
 public:
  /// See TightCoupling. Throws std::invalid_argument for bad options.
  CoupledMatcher(const AlignOptions& align, double residual_deviation, const Executor& executor);

  MatchResult match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) override;

 private:
  ScanAligner<LioMap> aligner_;
  TightCoupling coupling_;
  Executor executor_;
  std::vector<Eigen::Vector3f> points_, normals_;
};

}  // namespace nvm::lio
