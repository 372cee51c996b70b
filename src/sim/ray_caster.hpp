// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>

#include "sim/scene.hpp"

namespace nvm::sim {

/// What a ray has hit. Objects are counted through boxes, then cylinders, then meshes; the face is
/// that of the box (face_index), 0 for a cylinder's side and 1 for its ends, or the triangle.
struct SurfaceId {
  std::uint32_t object = 0;
  std::uint32_t face = 0;
};

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
  RayCaster(RayCaster&&) noexcept;
  ~RayCaster();

  /// The first surface that the ray from `origin` [m, world frame] along the unit vector
  /// `direction` meets from outside within `max_range` [m]. `pass` in [0, 1) is the ray's luck with
  /// glass: it goes through what has a higher transmission.
  std::optional<RayHit> cast(
      const Eigen::Vector3d& origin,
      const Eigen::Vector3d& direction,
      double max_range,
      double pass = 1.0) const;

  const Material& material(const SurfaceId& surface) const;

 private:
  struct Embree;

  const Scene& scene_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace nvm::sim
