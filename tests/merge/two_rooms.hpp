// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "merge/merge.hpp"
#include "sim/ray_caster.hpp"
#include "sim/scene_file.hpp"
#include "support/rng.hpp"

namespace nvm::test {

/// Two furnished rooms of 6 x 5 m with a wall of 10 cm and a doorway between them.
inline constexpr const char* kRooms = R"yaml(
description: two rooms
hulls:
  - {name: shell, min: [-6, 0, 0], max: [6, 5, 2.6]}
walls:
  - {name: divider, from: [0, 0], to: [0, 5], thickness: 0.1, height: 2.6, openings: [{from: 3.4, to: 4.5}]}
boxes:
  - {name: cupboard, min: [-5.9, 0.1, 0.1], max: [-4.6, 0.6, 2.0]}
  - {name: chest, min: [-3.0, 4.3, 0.1], max: [-1.8, 4.9, 0.8]}
  - {name: pillar, min: [-2.0, 0.8, 0.1], max: [-1.6, 1.3, 2.5]}
  - {name: bench, min: [2.4, 0.1, 0.1], max: [4.6, 0.5, 0.5]}
  - {name: locker, min: [5.2, 3.1, 0.1], max: [5.9, 4.7, 1.8]}
  - {name: column, min: [2.9, 2.8, 0.1], max: [3.3, 3.1, 2.5]}
)yaml";

/// A building that has nothing to do with these.
inline constexpr const char* kHall = R"yaml(
description: a hall
hulls:
  - {name: hall, min: [-9, -2, 0], max: [9, 6, 3.4]}
boxes:
  - {name: stage, min: [4, -1, 0.1], max: [8, 3, 0.9]}
  - {name: post, min: [-3, 1, 0.1], max: [-2.5, 1.5, 3.3]}
)yaml";

using Poses = std::vector<Pose>;

inline Pose at(double x, double y, double yaw = 0.0) {
  Pose pose = Pose::Identity();
  pose.translation() << x, y, 1.2;
  pose.linear() = so3_exp({0.0, 0.0, yaw});
  return pose;
}

inline const Pose kElsewhere = at(3.0, -2.0, 2.1);  ///< where the second session has its world

inline Poses joined(Poses a, const Poses& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline Poses west() { return {at(-4, 3.5, 0.4), at(-4, 2), at(-2, 3, 2.0)}; }
inline Poses east() { return {at(1.5, 4, 1.0), at(2, 2), at(4, 2, 2.0)}; }
inline Poses doorway() { return {at(-0.5, 4.0), at(0, 3.95), at(0.4, 4.0, -0.4)}; }

class MergeTest : public ::testing::Test {
 protected:
  /// What a run that passes `places` in the scene leaves, whose map lies at T_session_world.
  merge::Session session(
      const std::string& scene_text,
      const Poses& places,
      const Pose& T_session_world,
      const MapOptions& options = {}) {
    const sim::Scene scene = sim::parse_scene(scene_text, "test");
    const sim::RayCaster rays(scene);
    merge::Session session{"run", VoxelMap(options), {}};
    for (const Pose& T_world_lidar : places) {
      io::Keyframe keyframe;
      keyframe.T_map_lidar = T_session_world * T_world_lidar;
      look(rays, T_world_lidar, 10'000, keyframe);
      session.map.insert(keyframe.points, keyframe.normals, keyframe.T_map_lidar);
      keyframe.points.resize(2000);
      keyframe.normals.resize(2000);
      session.keyframes.push_back(keyframe);
    }
    return session;
  }

  /// The first session saw the west room, the second, whose map lies at `T_session_world`, the east
  /// one; both stood in the doorway.
  std::vector<merge::Session> both_rooms(const Pose& T_session_world = kElsewhere) {
    std::vector<merge::Session> sessions;
    sessions.push_back(session(kRooms, joined(west(), doorway()), Pose::Identity()));
    sessions.push_back(session(kRooms, joined(east(), doorway()), T_session_world));
    return sessions;
  }

  /// A world that is not level.
  static Pose tilted() {
    Pose tilted = kElsewhere;
    tilted.linear() = so3_exp({1.0, -0.4, 0.0}) * kElsewhere.linear();
    return tilted;
  }

  static merge::Merged merged(
      const std::vector<merge::Session>& sessions, const Poses& guesses = {}) {
    return merge::merge_sessions(sessions, guesses, Executor());
  }

  static std::string refusal(const std::vector<merge::Session>& sessions) {
    try {
      merged(sessions);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "merged";
  }

  /// How far the fit is off [m] at a corner of the building.
  static double error(const merge::SessionFit& fit, const Pose& T_session_world) {
    const Eigen::Vector3d corner(6.0, 5.0, 2.6);
    return (fit.T_map_session * (T_session_world * corner) - corner).norm();
  }

 private:
  void look(
      const sim::RayCaster& rays,
      const Pose& T_world_lidar,
      std::size_t count,
      io::Keyframe& scan) {
    constexpr double kNoise = 0.005;  // [m]
    std::normal_distribution<double> normal;
    while (scan.points.size() < count) {
      const Eigen::Vector3d direction =
          Eigen::Vector3d(normal(random_), normal(random_), normal(random_)).normalized();
      const auto hit =
          rays.cast(T_world_lidar.translation(), T_world_lidar.linear() * direction, 50.0);
      if (hit) {
        scan.points.push_back((direction * (hit->range + kNoise * normal(random_))).cast<float>());
        scan.normals.push_back(
            (T_world_lidar.linear().transpose() * hit->normal).cast<float>().normalized());
      }
    }
  }

  std::mt19937_64 random_ = test::rng();
};

}  // namespace nvm::test
