// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan_preparer.hpp"

#include "lio/plane_projection.hpp"

namespace nvm::lio {

namespace {

/// Of the points that get their plane from the map [m].
constexpr double kSettledSpacing = 0.15;

}  // namespace

ScanPreparer::ScanPreparer(
    const NormalOptions& normals, double max_plane_offset, const Executor& executor)
    : estimator_(normals),
      max_plane_offset_(max_plane_offset),
      executor_(executor),
      settler_(kSettledSpacing, executor) {}

void ScanPreparer::prepare(PreparedScan& prepared) {
  DeskewedScan& scan = prepared.scan;
  prepared.normals = project_to_planes(
      estimator_.estimate(scan.points, scan.viewpoints, executor_), max_plane_offset_, scan);
}

InsertStats ScanPreparer::insert(const Pose& T_map_lidar, PreparedScan& prepared, LioMap& map) {
  settler_.settle(map, T_map_lidar, prepared.scan.points, prepared.normals);
  return map.insert(prepared.scan.points, prepared.normals, T_map_lidar);
}

}  // namespace nvm::lio
