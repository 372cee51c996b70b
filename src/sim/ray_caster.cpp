// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/ray_caster.hpp"

#include <cmath>

#include "sim/embree_scene.hpp"
#include "sim/solid_intersection.hpp"

namespace nvm::sim {

RayCaster::RayCaster(const Scene& scene)
    : scene_(scene), embree_(std::make_unique<EmbreeScene>(scene)) {
  for (const Box& box : scene.boxes) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        const Face face = box_face(box, axis, side);
        box_planes_.push_back({face.normal, face.offset});
      }
    }
  }
  for (const Mesh& mesh : scene.meshes) {
    std::vector<Plane>& planes = mesh_planes_.emplace_back();
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d& p = mesh.vertices[a];
      const Eigen::Vector3d normal =
          (mesh.vertices[b] - p).cross(mesh.vertices[c] - p).normalized();
      planes.push_back({normal, normal.dot(p)});
    }
  }
}

RayCaster::~RayCaster() = default;

const RayCaster::Plane& RayCaster::plane_of(const SurfaceId& surface) const {
  constexpr std::size_t kFaces = 6;
  const std::size_t boxes = scene_.boxes.size();
  return surface.object < boxes
             ? box_planes_[kFaces * surface.object + surface.face]
             : mesh_planes_[surface.object - boxes - scene_.cylinders.size()][surface.face];
}

std::optional<RayHit> RayCaster::cast(
    const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction,
    double max_range,
    double pass) const {
  const auto candidate = embree_->nearest({origin, direction, max_range, pass});
  if (!candidate) {
    return std::nullopt;
  }
  const SurfaceId surface = candidate->surface;
  if (const Cylinder* cylinder = find_cylinder(scene_, surface.object)) {
    const auto entry = enter_cylinder(*cylinder, origin, direction);
    return RayHit{entry->range, entry->normal, {surface.object, entry->face}};
  }
  const Plane& plane = plane_of(surface);
  const double exact = plane_range(origin, direction, plane.normal, plane.offset);
  // They differ by more only when the ray runs along the face, where the plane says little.
  constexpr double kMaxCorrection = 1e-3;
  const bool is_reliable = std::abs(exact - candidate->range) < kMaxCorrection;
  const double sign = plane.normal.dot(direction) < 0.0 ? 1.0 : -1.0;
  return RayHit{is_reliable ? exact : candidate->range, sign * plane.normal, surface};
}

}  // namespace nvm::sim
