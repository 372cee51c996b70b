// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "nvm/geometry/pose.hpp"

namespace nvm::eval {

/// A point of a map under evaluation.
struct OrientedPoint {
  Eigen::Vector3d position;  ///< [m]
  Eigen::Vector3d normal;    ///< unit, towards the side that the sensor saw; zero: unknown
};

/// The points of a map in one frame.
struct OrientedCloud {
  std::vector<OrientedPoint> points;
  std::size_t non_finite = 0;  ///< points of the file that were left out: a NaN or an infinity

  /// True when any point knows its normal, and so the side of the wall that it lies on.
  bool has_normals() const;
};

/// The map in the PLY or PCD file `path`. Normals are brought to unit length; those shorter than
/// 0.5 count as unknown. Throws std::runtime_error, naming the file, when it is missing or
/// malformed.
OrientedCloud read_oriented_cloud(const std::string& path);

/// `cloud` with positions and normals mapped by `T`.
OrientedCloud transformed(OrientedCloud cloud, const Pose& T);

}  // namespace nvm::eval
