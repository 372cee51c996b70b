// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "lio/match/plane_measurement.hpp"
#include "lio/match/scan_matcher.hpp"

namespace nvm::lio {

/// FAST-LIO style: the distances of the keypoints to their planes correct the filter directly, in
/// an iterated update with new correspondences whenever it has converged.
class FilterMatcher final : public ScanMatcher {
 public:
  FilterMatcher(
      const MeasurementOptions& measurement,
      const IterationOptions& iteration,
      const Executor& executor);

  MatchResult match(const LioMap& map, PreparedScan& scan, ErrorStateFilter& filter) override;

 private:
  MeasurementOptions options_;
  IterationOptions iteration_;
  PlaneMeasurement measurement_;
};

}  // namespace nvm::lio
