// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "eval/walls/oriented_cloud.hpp"
#include "eval/walls/wall.hpp"
#include "io/result/map_cloud.hpp"
#include "io/sequence/trajectory_io.hpp"

namespace nvm::test {

/// An empty folder of the running test's own.
inline std::filesystem::path test_folder() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = std::filesystem::path(::testing::TempDir()) / "nvm_eval" /
                      (std::string(info->test_suite_name()) + "." + info->name());
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

inline nlohmann::json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline nlohmann::json to_json(const eval::WallPiece& piece) {
  nlohmann::json faces = nlohmann::json::array();
  for (const eval::WallFace& face : piece.faces) {
    faces.push_back(
        {{"normal", to_json(face.plane.normal)},
         {"d", face.plane.offset},
         {"center", to_json(face.center)},
         {"u", to_json(face.u)},
         {"half_u", face.half_u},
         {"v", to_json(face.v)},
         {"half_v", face.half_v},
         {"hits", face.hits}});
  }
  return {
      {"wall", piece.wall},
      {"piece", piece.piece},
      {"thickness", piece.thickness},
      {"faces", faces}};
}

/// A loop around the origin, 100 poses at 10 Hz.
inline Trajectory loop_trajectory() {
  Trajectory trajectory;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.1 * i;
    StampedPose stamped;
    stamped.time = 1000.0 + t;
    stamped.pose.linear() = so3_exp({0.0, 0.05 * std::sin(t), 0.6 * t});
    stamped.pose.translation() =
        Eigen::Vector3d(3.0 * std::cos(0.6 * t), 3.0 * std::sin(0.6 * t), 1.0 + 0.1 * std::sin(t));
    trajectory.push_back(stamped);
  }
  return trajectory;
}

/// A sequence folder with what evaluation reads of it.
inline void write_truth(
    const std::filesystem::path& folder, const std::vector<eval::WallPiece>& walls) {
  std::filesystem::create_directories(folder);
  io::write_tum((folder / "groundtruth.tum").string(), loop_trajectory());
  nlohmann::json list = nlohmann::json::array();
  for (const eval::WallPiece& wall : walls) {
    list.push_back(to_json(wall));
  }
  write_text(folder / "scene.json", nlohmann::json{{"walls", list}}.dump());
}

/// A run folder whose map frame is moved from the world by `T_map_world`.
inline void write_run(
    const std::filesystem::path& folder,
    const eval::OrientedCloud& cloud,
    const Pose& T_map_world) {
  std::filesystem::create_directories(folder);
  Trajectory trajectory = loop_trajectory();
  for (StampedPose& stamped : trajectory) {
    stamped.pose = T_map_world * stamped.pose;
  }
  io::write_tum((folder / "trajectory.tum").string(), trajectory);
  io::MapCloud map;
  for (const eval::OrientedPoint& point : transformed(cloud, T_map_world).points) {
    map.positions.push_back(point.position);
    map.normals.push_back(point.normal.cast<float>());
  }
  io::write_map_cloud((folder / "map.ply").string(), map);
}

}  // namespace nvm::test
