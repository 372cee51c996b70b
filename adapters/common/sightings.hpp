// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "nvm/map/neighbor.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/registration/association.hpp"

/// What hosts' points with a sighting for a normal (nvm/map/sighting.hpp) need beyond the map:
/// hosts fit planes to whatever a search returns, and know of no normals but those of their points.
namespace nvm::adapters {

/// Whether neighbours that a search with `sighting` has found are a surface. Those of an edge or of
/// a single ring are none, and a host that got them would take the plane through them for one.
inline bool are_surface(
    const Neighbor* found, std::size_t count, const Eigen::Vector3f& sighting) noexcept {
  const std::optional<Plane> plane = fit_plane(found, count);
  return plane && SightingOptions{}.accept(*plane, sighting);
}

/// The normal of the surface that a point (frame of the map, m) with this `sighting` lies on, as
/// far as the map knows one; else the sighting.
inline Eigen::Vector3f settled_normal(
    const VoxelMap& map,
    const Eigen::Vector3d& point,
    const Eigen::Vector3f& sighting,
    VoxelMap::QueryContext& context) noexcept {
  AssociationOptions options;
  options.max_plane_distance = 0.05;  // what lies farther off lies on something else
  const Association found = associate(map, point, sighting, options, context);
  return found.status == AssociationStatus::kValid ? Eigen::Vector3f(found.normal.cast<float>())
                                                   : sighting;
}

}  // namespace nvm::adapters
