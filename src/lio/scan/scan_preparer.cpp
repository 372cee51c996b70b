// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/scan_preparer.hpp"

#include "lio/scan/plane_projection.hpp"
#include "nvm/registration/settle_sightings.hpp"

namespace nvm::lio {

namespace {

AssociationOptions settling_options() {
  AssociationOptions options;
  options.neighbors = 8;
  options.max_neighbor_distance = 0.6;
  options.max_plane_distance = 0.05;  // what lies farther off lies on something else
  return options;
}

}  // namespace

ScanPreparer::ScanPreparer(
    const NormalOptions& normals,
    double max_plane_offset,
    const KeypointOptions& keypoints,
    const Executor& executor)
    : estimator_(normals),
      max_plane_offset_(max_plane_offset),
      sampler_(keypoints),
      executor_(executor) {}

void ScanPreparer::prepare(PreparedScan& prepared) {
  DeskewedScan& scan = prepared.scan;
  prepared.normals = project_to_planes(
      estimator_.estimate(scan.points, scan.viewpoints, executor_), max_plane_offset_, scan);
  prepared.keypoints = sampler_.sample(scan.points, prepared.normals);
}

InsertStats ScanPreparer::insert(
    const Pose& T_map_lidar, PreparedScan& prepared, LioMap& map) const {
  settle_sightings(
      map,
      T_map_lidar,
      prepared.keypoints,
      settling_options(),
      prepared.scan.points,
      prepared.normals,
      executor_);
  return map.insert(prepared.scan.points, prepared.normals, prepared.scan.values, T_map_lidar);
}

}  // namespace nvm::lio
