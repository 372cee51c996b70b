// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "sim/scene.hpp"

namespace nvm::sim {

class EmbreeScene;

struct RayHit {
  double range = 0.0;      ///< [m]
  Eigen::Vector3d normal;  ///< unit, against the ray
  SurfaceId surface;
};

/// Casts rays into a scene. Embree finds the surface in single precision; the range is that of the
/// exact plane or cylinder in double precision. Safe to use from many threads at once.
class RayCaster {
 public:
  /// `scene` must outlive the caster.
  explicit RayCaster(const Scene& scene);
  ~RayCaster();

  /// The first surface that the ray from `origin` [m, world frame] along the unit vector
  /// `direction` meets from outside within `max_range` [m]. `pass` in [0, 1) is the ray's luck with
  /// glass: it goes through what has a higher transmission.
  std::optional<RayHit> cast(
      const Eigen::Vector3d& origin,
      const Eigen::Vector3d& direction,
      double max_range,
      double pass = 1.0) const;

 private:
  /// The plane {p : normal . p = offset}.
  struct Plane {
    Eigen::Vector3d normal;
    double offset = 0.0;
  };

  const Plane& plane_of(const SurfaceId& surface) const;

  const Scene& scene_;
  std::unique_ptr<EmbreeScene> embree_;
  std::vector<Plane> box_planes_;                ///< six per box
  std::vector<std::vector<Plane>> mesh_planes_;  ///< one per triangle
};

}  // namespace nvm::sim
