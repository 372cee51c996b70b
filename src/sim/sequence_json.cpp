// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/sequence_json.hpp"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

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

Json to_json(const TriadNoise& noise) {
  return {
      {"noise_density", noise.noise_density},
      {"bias_walk", noise.bias_walk},
      {"initial_bias", noise.initial_bias},
      {"scale_error", noise.scale_error},
      {"misalignment_deg", noise.misalignment_deg}};
}

Json to_json(const MotionOptions& motion) {
  return {
      {"speed", motion.speed},
      {"still_time", motion.still_time},
      {"height", motion.height},
      {"tilt_deg", motion.tilt_deg},
      {"gait", motion.gait},
      {"wander", motion.wander},
      {"waypoint_jitter", motion.waypoint_jitter}};
}

Json to_json(const LidarOptions& lidar) {
  return {
      {"scan_rate", lidar.scan_rate},
      {"range_noise", lidar.range_noise},
      {"range_noise_per_metre", lidar.range_noise_per_metre},
      {"range_noise_per_tangent", lidar.range_noise_per_tangent},
      {"mixed_pixels", lidar.mixed_pixels},
      {"outliers", lidar.outliers},
      {"dropouts", lidar.dropouts},
      {"min_range", lidar.min_range},
      {"max_range", lidar.max_range}};
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
      {"options",
       {{"motion", to_json(options.motion)},
        {"lidar", to_json(options.lidar)},
        {"imu",
         {{"rate", options.imu.rate},
          {"gravity", options.imu.gravity},
          {"gyro", to_json(options.imu.gyro)},
          {"accelerometer", to_json(options.imu.accelerometer)}}}}},
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
