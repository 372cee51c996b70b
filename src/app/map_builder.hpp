// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <vector>

#include "app/insert_totals.hpp"
#include "common/executor.hpp"
#include "lio/map/lio_map.hpp"
#include "lio/pipeline/pipeline_options.hpp"
#include "lio/scan/scan_preparer.hpp"
#include "nvm/geometry/trajectory.hpp"

namespace nvm::app {

/// Puts scans into a map at poses that are known.
class MapBuilder {
 public:
  /// The poses are interpolated where they are at most `max_gap` [s] apart. Throws
  /// std::invalid_argument for bad options.
  MapBuilder(const lio::PipelineOptions& options, const Trajectory& T_map_body, double max_gap);

  /// Adds a scan, deskewed along the trajectory. False when the trajectory says nothing about the
  /// scan's end, which may lie in a gap of it.
  bool add(const Scan& scan);

  /// The ends [s] of the scans that lie in such gaps.
  const std::vector<double>& in_gaps() const { return in_gaps_; }

  const lio::LioMap& map() const { return *map_; }
  const InsertTotals& inserted() const { return inserted_; }
  /// T_map_body at the ends of the scans that were added.
  const Trajectory& placed() const { return placed_; }

 private:
  lio::ReturnLimits returns_;
  lio::NavState end_;
  Trajectory trajectory_;
  double max_gap_;
  Trajectory placed_;
  std::vector<double> in_gaps_;
  Executor executor_;
  lio::ScanPreparer preparer_;
  std::unique_ptr<lio::LioMap> map_;
  std::vector<lio::MotionSegment> segments_;
  lio::PreparedScan scan_;
  InsertTotals inserted_;
};

}  // namespace nvm::app
