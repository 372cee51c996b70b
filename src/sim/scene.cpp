// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/scene.hpp"

namespace nvm::sim {

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

const std::string& object_name(const Scene& scene, std::size_t object) {
  if (object < scene.boxes.size()) {
    return scene.boxes[object].name;
  }
  object -= scene.boxes.size();
  if (object < scene.cylinders.size()) {
    return scene.cylinders[object].name;
  }
  return scene.meshes[object - scene.cylinders.size()].name;
}

}  // namespace nvm::sim
