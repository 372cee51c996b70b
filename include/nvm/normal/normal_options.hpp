// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"

namespace nvm {

/// How neighbourhoods are found.
enum class NormalMethod {
  kBlockTree,  ///< exact: a tree over the sorted scan, searched for several points at once
  kPerCell,    ///< the fast mode: cells of cell_size are summed up and share one normal
};

/// Configuration of a NormalEstimator. Aggregate; the estimator's constructor validates it.
struct NormalOptions {
  /// Points nearer to their viewpoint than this [m] are dropped, 0 to max_range; D_min.
  double min_range = 0.3;
  /// Points farther from their viewpoint than this [m] are dropped, up to 10 000; D_max.
  double max_range = 100.0;
  /// Radius of the neighbourhood of a point at min_range [m], 0.001 to max_radius; R_min.
  double min_radius = 0.1;
  /// Radius of the neighbourhood of a point at max_range [m], min_radius to 1000; R_max. The radius
  /// grows linearly between the two (Eq. 1 as decided in spec §2.2) and is fixed when they are
  /// equal.
  double max_radius = 4.0;
  /// Points that a neighbourhood needs, the point itself included, 3 to 1 000 000; Ng_thres.
  int min_neighbors = 6;
  /// Largest share of the first eigenvalue in the sum of the three, above 1/3 to 1; delta_thres of
  /// Eq. 2. Rejects neighbourhoods that are a line.
  double max_linearity = 0.9;
  /// Largest share of the third eigenvalue in the sum of the three, above 0 to 1/3: the surface
  /// variation. Rejects corners and clutter.
  double max_surface_variation = 0.03;
  /// A point whose neighbours are a line or too few is tried again with a radius this many times as
  /// large, 1 (never) to 10. The rings that a spinning LiDAR draws on a floor lie farther apart
  /// than the radius that suits a wall at that range: each is a line there.
  double widening = 1.0;
  NormalMethod method = NormalMethod::kBlockTree;
  /// With kPerCell: edge of a cell [m], 0.001 to 1000. A cell is a neighbour when its mean is
  /// within the radius, which is 1.5 cells at least.
  double cell_size = 0.2;

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  NVM_SHARED void validate() const {
    require(max_range > 0.0 && max_range <= 1e4, "max_range", max_range, "above 0 to 10000 [m]");
    require(
        min_range >= 0.0 && min_range < max_range, "min_range", min_range, "0 to max_range [m]");
    require(
        max_radius >= 0.001 && max_radius <= 1000.0, "max_radius", max_radius, "0.001 to 1000 [m]");
    require(
        min_radius >= 0.001 && min_radius <= max_radius,
        "min_radius",
        min_radius,
        "0.001 to max_radius [m]");
    require(
        min_neighbors >= 3 && min_neighbors <= 1'000'000,
        "min_neighbors",
        min_neighbors,
        "3 to 1000000");
    require(
        max_linearity > 1.0 / 3.0 && max_linearity <= 1.0,
        "max_linearity",
        max_linearity,
        "above 1/3 to 1");
    require(
        max_surface_variation > 0.0 && max_surface_variation <= 1.0 / 3.0,
        "max_surface_variation",
        max_surface_variation,
        "above 0 to 1/3");
    require(widening >= 1.0 && widening <= 10.0, "widening", widening, "1 to 10");
    require(cell_size >= 0.001 && cell_size <= 1000.0, "cell_size", cell_size, "0.001 to 1000 [m]");
  }
};

}  // namespace nvm
