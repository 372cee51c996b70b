// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "eval/walls/oriented_cloud.hpp"
#include "eval/walls/oriented_plane.hpp"
#include "eval/walls/wall_points.hpp"

namespace nvm::eval {

/// An oriented box around one wall that a user names in place of known faces. It should reach past
/// both faces by 10 cm or more, and end before their edges.
struct Region {
  std::string name;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();        ///< [m]
  Eigen::Vector3d size = Eigen::Vector3d::Ones();          ///< full edge lengths [m]
  Eigen::Vector3d rotation_deg = Eigen::Vector3d::Zero();  ///< roll, pitch, yaw: Rz Ry Rx
  double thickness = 0.0;                                  ///< as measured by hand [m]; 0: unknown
};

/// The regions in the YAML file `path`, a list `regions` of mappings with the members of Region.
/// Throws std::runtime_error or std::invalid_argument, naming the file and what is wrong in it.
std::vector<Region> read_regions(const std::string& path);

/// The two dominant opposite surfaces in a region.
struct RegionFaces {
  SidedPoints points;
  std::array<OrientedPlane, 2> planes;  ///< rough
};

/// Finds the wall in `region`: the axis is the main direction of all normals in the box, a point's
/// side is the sign of its normal along it, and each side's plane is where its points lie densest.
/// Nothing when one side is empty, as it is in clouds without normals.
std::optional<RegionFaces> find_faces(
    const OrientedCloud& cloud, const Region& region, double max_normal_angle);

}  // namespace nvm::eval
