// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/registration/settle_sightings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include "nvm/map/voxel_map.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Points = std::vector<Eigen::Vector3f>;
using Surface = std::function<Eigen::Vector3f(std::mt19937_64&)>;

constexpr double kNoise = 0.01;  // along the beam [m]

// The points of a sensor at the origin that sees `surface`, without normals.
struct View {
  Points points, seen;
  std::vector<std::uint32_t> all;
};

View view(const Surface& surface, int count, std::mt19937_64& rng) {
  std::normal_distribution<float> noise(0.0F, static_cast<float>(kNoise));
  View v;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f point = surface(rng);
    v.points.push_back(point + noise(rng) * point.normalized());
    v.seen.push_back(sighting(v.points.back(), Eigen::Vector3d::Zero()));
  }
  v.all.resize(v.points.size());
  std::iota(v.all.begin(), v.all.end(), 0U);
  return v;
}

float between(std::mt19937_64& rng, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(rng);
}

// Rings on a floor 1.25 m below, as scans from a few places draw them.
Eigen::Vector3f ring_on_floor(std::mt19937_64& rng) {
  const float radius = 2.5F + 0.12F * static_cast<float>(rng() % 12);
  const float angle = between(rng, -0.5F, 0.5F);
  return {radius * std::cos(angle), radius * std::sin(angle), -1.25F};
}
Eigen::Vector3f pole(std::mt19937_64& rng) {  // 6 cm thick, its front half
  const float angle = between(rng, 1.6F, 4.7F);
  return {2.0F + 0.03F * std::cos(angle), 0.03F * std::sin(angle), between(rng, -1.0F, 1.0F)};
}
Eigen::Vector3f edge(std::mt19937_64& rng) {  // within 15 cm of a convex edge
  const float from = between(rng, 0.0F, 0.15F);
  const bool left = rng() % 2 == 0;
  return {2.0F + 0.7F * from, left ? 0.7F * from : -0.7F * from, between(rng, -1.0F, 1.0F)};
}
Eigen::Vector3f foliage(std::mt19937_64& rng) {
  return {2.0F + between(rng, -0.2F, 0.2F), between(rng, -0.5F, 0.5F), between(rng, -0.5F, 0.5F)};
}

// How many of `asked` get a plane from a map that holds `stored` as sightings.
std::size_t settled(const View& stored, View& asked) {
  MapOptions options;
  options.min_point_distance = 0.07;
  VoxelMap map(options);
  map.insert(stored.points, stored.seen);
  AssociationOptions association;
  association.neighbors = 8;
  association.max_neighbor_distance = 0.6;
  association.max_plane_distance = 0.05;
  return settle_sightings(map, Pose::Identity(), asked.all, association, asked.points, asked.seen);
}

std::size_t settled(const Surface& surface, std::mt19937_64& rng) {
  const View stored = view(surface, 4000, rng);
  View asked = view(surface, 1000, rng);
  return settled(stored, asked);
}

TEST(SettleSightings, FindsTheFloorThatRingsHaveDrawn) {
  auto rng = test::rng();
  const View stored = view(ring_on_floor, 4000, rng);
  View asked = view(ring_on_floor, 1000, rng);
  EXPECT_GT(settled(stored, asked), 900U);
  double sum_sq = 0.0;
  for (std::size_t i = 0; i < asked.points.size(); ++i) {
    if (!is_sighting(asked.seen[i])) {
      EXPECT_GT(asked.seen[i].z(), 0.98F);
      sum_sq += std::pow(static_cast<double>(asked.points[i].z()) + 1.25, 2);
    }
  }
  EXPECT_LT(std::sqrt(sum_sq / 1000.0), 0.35 * kNoise);  // raw: 0.4 times the noise of the range
}

TEST(SettleSightings, LeavesPolesEdgesAndFoliage) {
  auto rng = test::rng();
  EXPECT_EQ(settled(pole, rng), 0U);
  EXPECT_LT(settled(foliage, rng), 50U);
}

// Points beside an edge lie on one of its faces. None may get a plane across it.
TEST(SettleSightings, TakesNoPlaneAcrossAnEdge) {
  auto rng = test::rng();
  const View stored = view(edge, 4000, rng);
  View asked = view(edge, 1000, rng);
  settled(stored, asked);
  const float cosine = std::cos(0.35F);
  const Eigen::Vector3f left(-std::sqrt(0.5F), std::sqrt(0.5F), 0.0F);
  const Eigen::Vector3f right(-std::sqrt(0.5F), -std::sqrt(0.5F), 0.0F);
  std::size_t across = 0;
  for (const Eigen::Vector3f& normal : asked.seen) {
    across += !is_sighting(normal) && normal.dot(left) < cosine && normal.dot(right) < cosine;
  }
  EXPECT_LT(across, 50U);
}

TEST(SettleSightings, LeavesPointsWithANormalAndThoseNotAskedFor) {
  auto rng = test::rng();
  const View stored = view(ring_on_floor, 4000, rng);
  View asked = view(ring_on_floor, 1000, rng);
  const Eigen::Vector3f sideways = Eigen::Vector3f::UnitX();
  asked.seen[0] = sideways;
  asked.all.resize(500);
  const View before = asked;
  settled(stored, asked);
  EXPECT_EQ(asked.seen[0], sideways);
  EXPECT_EQ(asked.points[0], before.points[0]);
  for (std::size_t i = 500; i < 1000; ++i) {
    EXPECT_EQ(asked.points[i], before.points[i]);
    EXPECT_EQ(asked.seen[i], before.seen[i]);
  }
}

TEST(SettleSightings, TakesNoPlaneThatTheBeamGrazes) {
  auto rng = test::rng();
  const Surface far_floor = [](std::mt19937_64& g) {
    return Eigen::Vector3f(between(g, 14.0F, 16.0F), between(g, -1.0F, 1.0F), -1.25F);
  };
  EXPECT_EQ(settled(far_floor, rng), 0U);
}

}  // namespace
}  // namespace nvm
