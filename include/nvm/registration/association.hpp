// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "nvm/core/finite.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"
#include "nvm/map/map_concept.hpp"
#include "nvm/map/neighbor.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/registration/plane.hpp"
#include "nvm/registration/sighting_options.hpp"

namespace nvm {

/// How a scan point finds its plane in the map (spec §4).
struct AssociationOptions {
  /// Neighbours that the plane is fitted to at most, 3 to kMaxNeighbors.
  std::size_t neighbors = 20;
  /// A plane needs this many, 3 to `neighbors`; k_min of spec §4.
  std::size_t min_neighbors = 5;
  /// Neighbours lie at most this far from the point [m], positive.
  double max_neighbor_distance = 1.0;
  /// The point lies at most this far from the plane [m], positive; d_max of spec §4.
  double max_plane_distance = 0.3;
  /// Share of the planarity in the weight, the rest is that of the closeness, 0 to 1; alpha of
  /// spec §4.
  double planarity_share = 0.9;
  /// When the plane is that of a point with a sighting for a normal.
  SightingOptions sighting;

  /// Throws std::invalid_argument with the name, the value and the allowed range of the first bad
  /// member.
  NVM_SHARED void validate() const;
};

enum class AssociationStatus : std::uint8_t {
  kValid,
  kTooFewNeighbors,  ///< fewer than min_neighbors within max_neighbor_distance (none for NaN)
  kNoPlane,          ///< the neighbours are collinear or coincide, or no surface of a sighting
  kTooFar,           ///< farther from the plane than max_plane_distance
};

/// The plane that a scan point belongs to. Only `status` means something unless it is kValid.
struct Association {
  Eigen::Vector3d normal;  ///< unit, map frame, oriented to agree with the point's own normal
  double distance;         ///< signed, from the plane to the point along `normal` [m]
  double weight;           ///< 0 to 1, spec §4
  AssociationStatus status;
};

inline namespace NVM_TARGET {

/// Finds the plane of one point (spec §4): position and unit normal in the map frame. A sighting
/// (nvm/map/sighting.hpp) instead of a normal gets the plane if it is a surface. A zero normal
/// stands for "unknown": the plane is then not oriented (and a map with normals answers as its own
/// documentation says). Never throws; safe from many threads while nobody changes the map,
/// with a context for each.
template <class Map>
Association associate(
    const Map& map,
    const Eigen::Vector3d& point,
    const Eigen::Vector3f& normal,
    const AssociationOptions& options,
    typename Map::QueryContext& context) noexcept {
  static_assert(is_map_v<Map>, "nvm: this type does not model the map concept (map_concept.hpp)");
  Association result{};
  std::array<Neighbor, kMaxNeighbors> found;
  const std::size_t count = map.nearest(
      point, normal, {options.neighbors, options.max_neighbor_distance}, found.data(), context);
  if (count < options.min_neighbors) {
    result.status = AssociationStatus::kTooFewNeighbors;
    return result;
  }
  const std::optional<Plane> plane = fit_plane(found.data(), count);
  if (!plane || (is_sighting(normal) && !options.sighting.accept(*plane, normal))) {
    result.status = AssociationStatus::kNoPlane;
    return result;
  }
  const double sign = detail::dot(plane->normal, detail::cast<double>(normal)) < 0.0 ? -1.0 : 1.0;
  result.normal = detail::per_axis([&](int axis) { return sign * plane->normal[axis]; });
  result.distance = detail::dot(result.normal, detail::difference(point, plane->centroid));
  if (!(std::abs(result.distance) <= options.max_plane_distance)) {
    result.status = AssociationStatus::kTooFar;
    return result;
  }
  const double closeness = std::exp(
      -std::sqrt(static_cast<double>(found[0].sq_distance)) /
      (options.max_plane_distance * static_cast<double>(options.min_neighbors)));
  result.weight = options.planarity_share * plane->planarity * plane->planarity +
                  (1.0 - options.planarity_share) * closeness;
  result.status = AssociationStatus::kValid;
  return result;
}

}  // namespace NVM_TARGET

inline void AssociationOptions::validate() const {
  require(neighbors >= 3 && neighbors <= kMaxNeighbors, "neighbors", neighbors, "3 to 64");
  require(
      min_neighbors >= 3 && min_neighbors <= neighbors,
      "min_neighbors",
      min_neighbors,
      "3 to neighbors");
  require(
      max_neighbor_distance > 0.0 && detail::is_finite(max_neighbor_distance),
      "max_neighbor_distance",
      max_neighbor_distance,
      "positive [m]");
  require(
      max_plane_distance > 0.0 && detail::is_finite(max_plane_distance),
      "max_plane_distance",
      max_plane_distance,
      "positive [m]");
  require(
      planarity_share >= 0.0 && planarity_share <= 1.0,
      "planarity_share",
      planarity_share,
      "0 to 1");
  sighting.validate();
}

}  // namespace nvm
