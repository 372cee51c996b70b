// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nvm/geometry/pose.hpp"

namespace nvm::sim {

struct Material {
  double reflectivity = 0.5;  ///< diffuse, at the LiDAR's wavelength, 0 to 1
  double transmission = 0.0;  ///< share of the rays that pass as if nothing was there, 0 to 1
  double mirror = 0.0;        ///< share of the rays that are thrown back as by a mirror, 0 to 1
};

struct Box {
  std::string name;
  Pose T_world_box = Pose::Identity();  ///< of the box's centre
  Eigen::Vector3d half_size;            ///< [m]
  Material material;
};

struct Cylinder {
  std::string name;
  Pose T_world_cylinder = Pose::Identity();  ///< of the centre; the axis is z
  double radius = 0.0;                       ///< [m]
  double half_height = 0.0;                  ///< [m]
  Material material;
};

struct Mesh {
  std::string name;
  std::string file;
  std::vector<Eigen::Vector3d> vertices;  ///< in the world frame
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Material material;
};

/// A surface of a scene. Objects are counted through boxes, then cylinders, then meshes; the face
/// is that of the box (face_index), 0 for a cylinder's side and 1 for its ends, or the triangle.
struct SurfaceId {
  std::uint32_t object = 0;
  std::uint32_t face = 0;
};

/// A rectangle on the plane {p : normal . p = offset}, facing along its unit normal.
struct Face {
  Eigen::Vector3d normal;
  double offset = 0.0;
  Eigen::Vector3d center;
  Eigen::Vector3d u;  ///< unit vector along one edge
  double half_u = 0.0;
  Eigen::Vector3d v;
  double half_v = 0.0;
};

/// One rectangular piece of a thin wall, a box of the scene: what remains of the wall beside, above
/// or below its openings.
struct WallPiece {
  std::string wall;
  int piece = 0;          ///< counts within the wall
  std::size_t box = 0;    ///< index in Scene::boxes
  Eigen::Index axis = 0;  ///< the box axis across the wall
};

/// Where the sensor is carried.
struct Route {
  std::vector<Eigen::Vector3d> waypoints;  ///< feet: x, y and the height of the floor [m]
  double speed = 0.9;                      ///< [m/s]
  int laps = 1;                            ///< of a closed route (first waypoint = last)
};

/// Somebody who walks to and fro along a path: an upright cylinder.
struct Person {
  std::vector<Eigen::Vector3d> path;  ///< feet [m]
  double speed = 1.0;                 ///< [m/s]
  double radius = 0.22;               ///< [m]
  double height = 1.75;               ///< [m]
};

/// Everything that rays can hit, the thin walls among it that are ground truth, and a route.
struct Scene {
  std::string name;
  std::string description;
  std::vector<Box> boxes;
  std::vector<Cylinder> cylinders;
  std::vector<Mesh> meshes;
  std::vector<WallPiece> wall_pieces;
  std::vector<Person> people;
  Route route;
};

/// Thickness of the wall at `piece` [m].
double thickness(const Scene& scene, const WallPiece& piece);

/// Face `side` (0: against the axis, 1: along it) of a box, seen from outside.
Face box_face(const Box& box, Eigen::Index axis, int side);

/// The cylinder with that SurfaceId::object; null when it is a box or a mesh.
const Cylinder* find_cylinder(const Scene& scene, std::size_t object);

const std::string& object_name(const Scene& scene, std::size_t object);
const Material& object_material(const Scene& scene, std::size_t object);

/// Index of that face among the six of its box: -x, +x, -y, +y, -z, +z.
inline std::uint32_t face_index(Eigen::Index axis, int side) {
  return static_cast<std::uint32_t>(2 * axis + side);
}

}  // namespace nvm::sim
