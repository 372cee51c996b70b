// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/ray_caster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/scene_fixtures.hpp"
#include "sim/solid_intersection.hpp"
#include "support/rng.hpp"

namespace nvm::sim {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Where a ray enters a box, by the method of slabs in double precision.
double enter_box(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d o =
      box.T_world_box.linear().transpose() * (origin - box.T_world_box.translation());
  const Eigen::Vector3d d = box.T_world_box.linear().transpose() * direction;
  const Eigen::Array3d first = (-box.half_size - o).array() / d.array();
  const Eigen::Array3d second = (box.half_size - o).array() / d.array();
  const double enter = first.min(second).maxCoeff();
  const double leave = first.max(second).minCoeff();
  return enter < leave && enter > 0.0 ? enter : kNothing;
}

/// The nearest range over all solids, one by one.
double brute_force(
    const Scene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double nearest = kNothing;
  for (const Box& box : scene.boxes) {
    nearest = std::min(nearest, enter_box(box, origin, direction));
  }
  for (const Cylinder& cylinder : scene.cylinders) {
    const auto entry = enter_cylinder(cylinder, origin, direction);
    nearest = std::min(nearest, entry ? entry->range : kNothing);
  }
  return nearest;
}

TEST(RayCaster, AgreesWithTheBruteForceOverAllSolids) {
  auto rng = test::rng();
  const Scene scene = test::random_scene(rng, 60);
  const RayCaster rays(scene);
  int hits = 0;
  int disagreements = 0;
  constexpr int kRays = 20000;
  for (int i = 0; i < kRays; ++i) {
    const Eigen::Vector3d origin = test::random_vector(rng, 8.0);
    const Eigen::Vector3d direction = test::random_vector(rng, 1.0).normalized();
    const double expected = brute_force(scene, origin, direction);
    const auto hit = rays.cast(origin, direction, 1000.0);
    const double range = hit ? hit->range : kNothing;
    hits += hit.has_value();
    // Rays that graze an edge may go either way; there must be very few.
    disagreements += !(range == expected || std::abs(range - expected) < 1e-9);
    if (hit) {
      EXPECT_LT(hit->normal.dot(direction), 0.0);
      EXPECT_NEAR(hit->normal.norm(), 1.0, 1e-9);
    }
  }
  EXPECT_GT(hits, kRays / 10);
  EXPECT_LE(disagreements, 2);
}

TEST(RayCaster, IsExactAtLongRange) {
  Scene scene;
  scene.boxes.resize(1);
  scene.boxes[0].half_size = Eigen::Vector3d(0.015, 40.0, 40.0);
  scene.boxes[0].T_world_box = shift({300.0, 0.0, 0.0});
  const RayCaster rays(scene);
  auto rng = test::rng();
  std::uniform_real_distribution<double> slope(-0.1, 0.1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d direction = Eigen::Vector3d(1.0, slope(rng), slope(rng)).normalized();
    const auto hit = rays.cast(Eigen::Vector3d(0.1, 0.2, 0.3), direction, 1000.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(0.1 + hit->range * direction.x(), 299.985, 1e-10);
    EXPECT_EQ(hit->surface.face, face_index(0, 0));
  }
}

TEST(RayCaster, NamesTheFaceOfABox) {
  Scene scene;
  scene.boxes.resize(1);
  scene.boxes[0].half_size = Eigen::Vector3d(1.0, 2.0, 3.0);
  const RayCaster rays(scene);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Face face = box_face(scene.boxes[0], axis, side);
      const auto hit = rays.cast(face.center + 4.0 * face.normal, -face.normal, 10.0);
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->range, 4.0, 1e-12);
      EXPECT_EQ(hit->surface.face, face_index(axis, side));
      EXPECT_TRUE(hit->normal.isApprox(face.normal));
    }
  }
}

TEST(RayCaster, LeavesASolidFromInsideUnseen) {
  Scene scene;
  scene.boxes.resize(1);
  scene.boxes[0].half_size = Eigen::Vector3d::Ones();
  const RayCaster rays(scene);
  EXPECT_FALSE(rays.cast(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 10.0));
}

TEST(RayCaster, StopsAtTheMaximumRange) {
  Scene scene;
  scene.boxes.resize(1);
  scene.boxes[0].half_size = Eigen::Vector3d::Ones();
  const RayCaster rays(scene);
  const Eigen::Vector3d origin(-10.0, 0.1, 0.2);
  EXPECT_FALSE(rays.cast(origin, Eigen::Vector3d::UnitX(), 8.99));
  EXPECT_TRUE(rays.cast(origin, Eigen::Vector3d::UnitX(), 9.01));
}

TEST(RayCaster, LetsLuckyRaysThroughGlassOntoWhatTouchesItBehind) {
  Scene scene;
  scene.boxes.resize(2);
  scene.boxes[0].half_size = Eigen::Vector3d(0.01, 1.0, 1.0);
  scene.boxes[0].material.transmission = 0.7;
  scene.boxes[1].half_size = Eigen::Vector3d(0.5, 1.0, 1.0);
  scene.boxes[1].T_world_box = shift({0.51, 0.0, 0.0});
  scene.cylinders.resize(1);
  scene.cylinders[0].T_world_cylinder = shift({-1.0, 0.0, 0.0});
  scene.cylinders[0].radius = 0.1;
  scene.cylinders[0].half_height = 1.0;
  scene.cylinders[0].material.transmission = 0.4;
  const RayCaster rays(scene);
  const Eigen::Vector3d origin(-5.0, 0.01, 0.02);
  const auto object_hit = [&](double pass) {
    return rays.cast(origin, Eigen::Vector3d::UnitX(), 10.0, pass)->surface.object;
  };
  EXPECT_EQ(object_hit(0.8), 2U);
  EXPECT_EQ(object_hit(0.5), 2U);
  EXPECT_EQ(object_hit(0.39), 1U);
}

TEST(RayCaster, HitsMeshesFromBothSides) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].vertices = {{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {0.0, 1.0, 1.0}};
  scene.meshes[0].triangles = {{0, 1, 2}};
  const RayCaster rays(scene);
  const Eigen::Vector3d below(0.2, 0.2, 0.0);
  const Eigen::Vector3d above(0.2, 0.2, 3.0);
  const auto up = rays.cast(below, Eigen::Vector3d::UnitZ(), 10.0);
  const auto down = rays.cast(above, -Eigen::Vector3d::UnitZ(), 10.0);
  ASSERT_TRUE(up && down);
  EXPECT_NEAR(up->range, 1.0, 1e-12);
  EXPECT_NEAR(down->range, 2.0, 1e-12);
  EXPECT_TRUE(up->normal.isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(down->normal.isApprox(Eigen::Vector3d::UnitZ()));
}

}  // namespace
}  // namespace nvm::sim
