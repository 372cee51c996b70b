// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <random>

#include "eval/walls/oriented_cloud.hpp"
#include "eval/walls/wall.hpp"

namespace nvm::test {

/// A wall of 4 x 2.4 m in the plane x = 0 of a frame that is placed by `T_world_wall`.
inline eval::WallPiece make_wall(double thickness, const Pose& T_world_wall = Pose::Identity()) {
  eval::WallPiece wall;
  wall.wall = "wall";
  wall.thickness = thickness;
  for (std::size_t side = 0; side < 2; ++side) {
    eval::WallFace& face = wall.faces[side];
    const Eigen::Vector3d normal = (side == 0 ? 1.0 : -1.0) * Eigen::Vector3d::UnitX();
    face.plane.normal = T_world_wall.linear() * normal;
    face.center = T_world_wall * Eigen::Vector3d(0.5 * thickness * normal);
    face.plane.offset = face.plane.normal.dot(face.center);
    face.u = T_world_wall.linear() * Eigen::Vector3d::UnitY();
    face.v = T_world_wall.linear() * Eigen::Vector3d::UnitZ();
    face.half_u = 2.0;
    face.half_v = 1.2;
    face.hits = 100000;
  }
  return wall;
}

/// How a face is sampled.
struct FaceSampling {
  std::size_t count = 2000;
  double noise = 0.01;  ///< standard deviation along the normal [m]
  double skew = 1.0;    ///< 1: uniform; larger: denser towards one end of the wall
};

/// Points of one face of `wall` with its true normal, up to the face's very edges.
inline void sample_face(
    std::mt19937_64& rng,
    const eval::WallFace& face,
    const FaceSampling& sampling,
    eval::OrientedCloud& cloud) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < sampling.count; ++i) {
    const double along = 2.0 * std::pow(uniform(rng), sampling.skew) - 1.0;
    const double up = 2.0 * uniform(rng) - 1.0;
    const Eigen::Vector3d p = face.center + along * face.half_u * face.u +
                              up * face.half_v * face.v +
                              sampling.noise * normal(rng) * face.plane.normal;
    cloud.points.push_back({p, face.plane.normal});
  }
}

/// Both faces of `wall`, sampled alike; denser towards opposite ends when skewed.
inline eval::OrientedCloud sample_wall(
    std::mt19937_64& rng, const eval::WallPiece& wall, const FaceSampling& sampling = {}) {
  eval::OrientedCloud cloud;
  sample_face(rng, wall.faces[0], sampling, cloud);
  eval::WallFace turned = wall.faces[1];
  turned.u = -turned.u;
  sample_face(rng, turned, sampling, cloud);
  return cloud;
}

/// A rigid transform of up to `max_angle` [rad] and `max_shift` [m].
inline Pose random_pose(std::mt19937_64& rng, double max_angle, double max_shift) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Eigen::Vector3d(uniform(rng), uniform(rng), uniform(rng)); };
  Pose pose = Pose::Identity();
  pose.linear() = so3_exp(max_angle * vector() / std::sqrt(3.0));
  pose.translation() = max_shift * vector();
  return pose;
}

}  // namespace nvm::test
