// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lio/executor.hpp"
#include "lio/lio_map.hpp"
#include "nvm/map/voxel_set.hpp"
#include "nvm/registration/association.hpp"

namespace nvm::lio {

/// Gives the points of a scan that have no plane of their own that of the map, on their way into
/// it. Keeps its memory from scan to scan.
class SightingSettler {
 public:
  /// At most one point in each cube of edge `spacing` [m] is looked at: the map stores no more.
  SightingSettler(double spacing, const Executor& executor);

  /// See settle_sightings(). `points` [m] and `normals` are in the scan frame.
  void settle(
      const LioMap& map,
      const Pose& T_map_scan,
      std::vector<Eigen::Vector3f>& points,
      std::vector<Eigen::Vector3f>& normals);

 private:
  AssociationOptions options_;
  Executor executor_;
  VoxelSet cubes_;
  std::vector<std::uint32_t> chosen_;
};

}  // namespace nvm::lio
