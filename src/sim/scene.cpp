// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/scene.hpp"

namespace nvm::sim {
namespace {

/// `function(box, cylinder or mesh)` of the object with that number.
template <class Function>
decltype(auto) with_object(const Scene& scene, std::size_t object, const Function& function) {
  const std::size_t boxes = scene.boxes.size();
  if (object < boxes) {
    return function(scene.boxes[object]);
  }
  if (const Cylinder* cylinder = find_cylinder(scene, object)) {
    return function(*cylinder);
  }
  return function(scene.meshes[object - boxes - scene.cylinders.size()]);
}

}  // namespace

double thickness(const Scene& scene, const WallPiece& piece) {
  return 2.0 * scene.boxes[piece.box].half_size[piece.axis];
}

Face box_face(const Box& box, Eigen::Index axis, int side) {
  const Eigen::Index axis_u = (axis + 1) % 3;
  const Eigen::Index axis_v = (axis + 2) % 3;
  const Eigen::Matrix3d R = box.T_world_box.linear();
  Face face;
  face.normal = (side == 0 ? -1.0 : 1.0) * R.col(axis);
  face.center = box.T_world_box.translation() + box.half_size[axis] * face.normal;
  face.offset = face.normal.dot(face.center);
  face.u = R.col(axis_u);
  face.half_u = box.half_size[axis_u];
  face.v = R.col(axis_v);
  face.half_v = box.half_size[axis_v];
  return face;
}

const Cylinder* find_cylinder(const Scene& scene, std::size_t object) {
  const std::size_t index = object - scene.boxes.size();  // of a box: wraps to a huge number
  return index < scene.cylinders.size() ? &scene.cylinders[index] : nullptr;
}

const std::string& object_name(const Scene& scene, std::size_t object) {
  return with_object(
      scene, object, [](const auto& solid) -> const std::string& { return solid.name; });
}

const Material& object_material(const Scene& scene, std::size_t object) {
  return with_object(
      scene, object, [](const auto& solid) -> const Material& { return solid.material; });
}

}  // namespace nvm::sim
