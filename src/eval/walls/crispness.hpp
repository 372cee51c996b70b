// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <optional>

#include "eval/walls/oriented_cloud.hpp"

namespace nvm::eval {

/// How sharply a map draws its surfaces, without any truth. Lower is crisper.
struct Crispness {
  /// Median over planar patches of their RMS thickness [m]; nothing when no patch is planar. In a
  /// map with normals a patch holds points of one side only, so that the other face of a thin wall
  /// does not count as blur.
  std::optional<double> plane_thickness;
  /// Mean map entropy (Droeschel and Behnke, ICRA 2014): the mean of ln det(2 pi e S) / 2 over the
  /// covariances S [m^2] of all patches, sides ignored.
  double mean_map_entropy = 0.0;
  std::size_t patches = 0;
};

/// Crispness of the patches of `radius` [m] around the points of `cloud`, of at most 20 000 of them
/// at even steps; patches have at least 8 points. Nothing when there is no such patch.
std::optional<Crispness> measure_crispness(const OrientedCloud& cloud, double radius = 0.3);

}  // namespace nvm::eval
