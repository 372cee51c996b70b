// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "nvm/map/neighbor.hpp"
#include "nvm/map/sighting.hpp"
#include "nvm/map/voxel_map.hpp"
#include "nvm/registration/association.hpp"

/// What hosts need beyond the map: they fit planes to whatever a search returns, and know of no
/// normals but those of their points.
namespace nvm::adapters {

/// The plane of neighbours that a search with `normal`, a unit vector or a sighting
/// (nvm/map/sighting.hpp), has found, or nothing when they are no surface: those of an edge, whose
/// slanting normal finds both of its sides, or of a single ring. `max_deviation` [m]: of a
/// surface's points from its plane, one standard deviation.
inline std::optional<Plane> surface_of(
    const Neighbor* found,
    std::size_t count,
    const Eigen::Vector3f& normal,
    double max_deviation) noexcept {
  const std::optional<Plane> plane = fit_plane(found, count);
  SightingOptions options;
  options.max_deviation = max_deviation;
  const bool accepts = plane && (is_sighting(normal) ? options.accept(*plane, normal)
                                                     : plane->deviation[0] <= max_deviation);
  return accepts ? plane : std::nullopt;
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

/// Learns how far points of one surface lie from its plane, so that a noisy sensor's walls pass for
/// surfaces. Most neighbourhoods in a thinned map may be none: the lowest tenth are walls.
class SurfaceNoise {
 public:
  /// Surfaces deviate at most so far from their planes [m], one standard deviation.
  double max_deviation() const noexcept { return std::max(kLeast, 3.0 * noise_); }

  /// Shows the neighbourhood of a point of which the map knows the normal.
  void show(const Neighbor* found, std::size_t count) {
    const std::optional<Plane> plane = fit_plane(found, count);
    if (!plane) {
      return;
    }
    deviations_.push_back(plane->deviation[0]);
    if (deviations_.size() == kSamples) {
      const auto tenth = deviations_.begin() + kSamples / 10;
      std::nth_element(deviations_.begin(), tenth, deviations_.end());
      noise_ = noise_ == 0.0 ? *tenth : noise_ + kRate * (*tenth - noise_);
      deviations_.clear();
    }
  }

 private:
  static constexpr double kLeast = 0.02;  // [m]; as SightingOptions::max_deviation
  static constexpr double kRate = 0.1;    // of the newest samples
  static constexpr std::size_t kSamples = 32;

  double noise_ = 0.0;  // [m]; 0: not known yet
  std::vector<double> deviations_;
};

}  // namespace nvm::adapters
