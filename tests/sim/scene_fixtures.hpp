// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <random>

#include "sim/angles.hpp"
#include "sim/scene.hpp"
#include "support/random_vector.hpp"

namespace nvm::test {

/// Boxes and cylinders of 0.1 to 1.5 m, turned at random, spread over 12 m.
inline sim::Scene random_scene(std::mt19937_64& rng, int solids_of_each_kind) {
  std::uniform_real_distribution<double> size(0.05, 0.75);
  sim::Scene scene;
  for (int i = 0; i < solids_of_each_kind; ++i) {
    sim::Box box;
    box.T_world_box =
        sim::make_pose(sim::euler_rotation_deg(random_vector(rng, 180.0)), random_vector(rng, 6.0));
    box.half_size = Eigen::Vector3d(size(rng), size(rng), size(rng));
    scene.boxes.push_back(box);
    sim::Cylinder cylinder;
    cylinder.T_world_cylinder =
        sim::make_pose(sim::euler_rotation_deg(random_vector(rng, 180.0)), random_vector(rng, 6.0));
    cylinder.radius = size(rng);
    cylinder.half_height = size(rng);
    scene.cylinders.push_back(cylinder);
  }
  return scene;
}

}  // namespace nvm::test
