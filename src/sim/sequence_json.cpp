// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/sequence_json.hpp"

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "config/schema.hpp"

namespace nvm::sim {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json to_json(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return {
      {"translation", to_json(pose.translation())},
      {"quaternion_xyzw", Json::array({q.x(), q.y(), q.z(), q.w()})}};
}

Json to_json(const Face& face, std::size_t hits) {
  return {
      {"normal", to_json(face.normal)},
      {"d", face.offset},
      {"center", to_json(face.center)},
      {"u", to_json(face.u)},
      {"half_u", face.half_u},
      {"v", to_json(face.v)},
      {"half_v", face.half_v},
      {"hits", hits}};
}

Json to_json(const Scene& scene, const WallPiece& piece, const SurfaceHits& hits) {
  Json faces = Json::array();
  for (int side = 0; side < 2; ++side) {
    const Face face = box_face(scene.boxes[piece.box], piece.axis, side);
    faces.push_back(to_json(face, hits.on_face(piece.box, face_index(piece.axis, side))));
  }
  return {
      {"wall", piece.wall},
      {"piece", piece.piece},
      {"thickness", thickness(scene, piece)},
      {"faces", faces}};
}

/// The same tree in JSON; texts that spell numbers become numbers.
Json to_json(const YAML::Node& yaml) {
  if (yaml.IsMap()) {
    Json object = Json::object();
    for (const auto& member : yaml) {
      object[member.first.Scalar()] = to_json(member.second);
    }
    return object;
  }
  if (yaml.IsSequence()) {
    Json array = Json::array();
    for (const YAML::Node& item : yaml) {
      array.push_back(to_json(item));
    }
    return array;
  }
  const auto number = config::parse_number(yaml.Scalar());
  return number ? Json(*number) : Json(yaml.Scalar());
}

Json to_json(SimulationOptions options) {
  config::Schema schema;
  bind(schema, options);
  return to_json(YAML::Load(schema.to_yaml()));
}

Json primitives_json(const Scene& scene) {
  Json primitives = Json::array();
  for (const Box& box : scene.boxes) {
    primitives.push_back(
        {{"type", "box"},
         {"name", box.name},
         {"pose", to_json(box.T_world_box)},
         {"half_size", to_json(box.half_size)}});
  }
  for (const Cylinder& cylinder : scene.cylinders) {
    primitives.push_back(
        {{"type", "cylinder"},
         {"name", cylinder.name},
         {"pose", to_json(cylinder.T_world_cylinder)},
         {"radius", cylinder.radius},
         {"half_height", cylinder.half_height}});
  }
  for (const Mesh& mesh : scene.meshes) {
    Json& json = primitives.emplace_back(Json{{"type", "mesh"}, {"name", mesh.name}});
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      json["vertices"].push_back(to_json(vertex));
    }
    json["triangles"] = mesh.triangles;
  }
  return primitives;
}

/// One line per primitive and per wall piece, for people and line-based tools.
std::string one_per_line(const Json& items) {
  std::string text;
  for (const Json& item : items) {
    text += (text.empty() ? "\n  " : ",\n  ") + item.dump();
  }
  return "[" + text + "\n]";
}

}  // namespace

std::string meta_json(
    const Scene& scene, const SimulationOptions& options, const SequenceFacts& facts) {
  const Json meta{
      {"format", "nvm sequence"},
      {"version", 1},
      {"scene", scene.name},
      {"sensor", options.sensor},
      {"seed", options.seed},
      {"T_imu_lidar", to_json(facts.T_imu_lidar)},
      {"options", to_json(options)},
      {"counts",
       {{"scans", facts.scans}, {"points", facts.points}, {"imu_samples", facts.imu_samples}}},
      {"files",
       {{"imu", "imu.csv"},
        {"scans", "scans.csv"},
        {"groundtruth", "groundtruth.tum"},
        {"scene", "scene.json"}}}};
  return meta.dump(2) + "\n";
}

std::string scene_json(const Scene& scene, const SurfaceHits& hits) {
  Json walls = Json::array();
  for (const WallPiece& piece : scene.wall_pieces) {
    walls.push_back(to_json(scene, piece, hits));
  }
  const Json name = scene.name;
  return "{\"name\": " + name.dump() +
         ",\n\"primitives\": " + one_per_line(primitives_json(scene)) +
         ",\n\"walls\": " + one_per_line(walls) + "}\n";
}

}  // namespace nvm::sim
