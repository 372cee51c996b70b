// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <stdexcept>

#include "adapters/common/host_map.hpp"
#include "adapters/host_point.hpp"
#include "nvm/registration/plane.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using adapters::HostMap;
using adapters::HostOptions;

/// A floor and a wall that meet at y = z = 0, in points of `noise` [m] off their planes, each with
/// its own normal.
test::HostPoints noisy_corner(double noise, std::mt19937_64& rng) {
  std::normal_distribution<double> off(0.0, noise);
  test::HostPoints points;
  for (double x = 0.05; x < 4.0; x += 0.1) {
    for (double far = 0.05; far < 2.0; far += 0.1) {
      points.push_back(test::host_point({x, far, off(rng)}, Eigen::Vector3f::UnitZ()));
      points.push_back(test::host_point({x, off(rng), far}, Eigen::Vector3f::UnitY()));
    }
  }
  return points;
}

HostMap surface_map(double noise) {
  HostOptions options;
  options.surface_neighbors = adapters::kSurfaceNeighbors;
  options.map.voxel_size = 0.5;
  options.map.min_point_distance = 0.05;
  HostMap map(options);
  std::mt19937_64 rng = test::rng();
  for (int scan = 0; scan < 3; ++scan) {  // from the second on, scans meet a map
    map.insert(noisy_corner(noise, rng));
  }
  return map;
}

TEST(HostMap, MovesNeighborsOntoTheSurfaceThatMoreOfThemMake) {
  constexpr double kNoise = 0.01;
  const HostMap map = surface_map(kNoise);
  const test::HostPoint floor = test::host_point({2.0, 1.0, 0.0}, Eigen::Vector3f::UnitZ());
  const NearestSearch search{5, 1.0, Gate::kSurfaces};
  std::array<Neighbor, 5> moved;
  ASSERT_EQ(map.nearest(floor, search, moved.data()), 5U);
  EXPECT_LT(fit_plane(moved.data(), 5)->deviation[0], 1e-6);
  std::array<Neighbor, adapters::kSurfaceNeighbors> all;
  VoxelMap::QueryContext context;
  const NearestSearch wider{all.size(), 1.0, Gate::kSurfaces};
  ASSERT_EQ(
      map.map()->nearest({2.0, 1.0, 0.0}, Eigen::Vector3f::UnitZ(), wider, all.data(), context),
      all.size());
  const Plane plane = *fit_plane(all.data(), all.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    EXPECT_EQ(moved[i].id, all[i].id);
    EXPECT_EQ(moved[i].sq_distance, all[i].sq_distance);
    EXPECT_NEAR(plane.normal.dot(moved[i].position - plane.centroid), 0.0, 1e-9);
    EXPECT_LT((moved[i].position - all[i].position).norm(), 5 * kNoise);
  }
}

TEST(HostMap, FindsNothingAtAnEdgeThatASlantingNormalFindsBothSidesOf) {
  const Eigen::Vector3f slanting = Eigen::Vector3f(0.0F, 1.0F, 1.0F).normalized();
  const test::HostPoint edge = test::host_point({2.0, 0.1, 0.1}, slanting);
  const NearestSearch search{5, 1.0, Gate::kSurfaces};
  std::array<Neighbor, 5> found;
  EXPECT_EQ(surface_map(0.005).nearest(edge, search, found.data()), 0U);
  HostMap as_they_are;
  std::mt19937_64 rng = test::rng();
  as_they_are.insert(noisy_corner(0.005, rng));
  EXPECT_EQ(as_they_are.nearest(edge, search, found.data()), 5U);
}

TEST(HostMap, LearnsHowFarTheSurfacesOfANoisySensorDeviate) {
  EXPECT_EQ(surface_map(0.003).max_surface_deviation(), 0.02);
  const HostMap noisy = surface_map(0.05);
  EXPECT_GT(noisy.max_surface_deviation(), 0.05);
  std::array<Neighbor, 5> found;
  std::size_t answered = 0;
  std::mt19937_64 rng = test::rng();
  const test::HostPoints points = noisy_corner(0.05, rng);
  for (const test::HostPoint& point : points) {
    answered += noisy.nearest(point, {5, 1.0, Gate::kSurfaces}, found.data()) == 5;
  }
  EXPECT_GT(answered, points.size() * 9 / 10);
}

TEST(HostMap, RefusesOptionsThatAreOutOfRange) {
  for (const std::size_t neighbors : {std::size_t{1}, std::size_t{2}, kMaxNeighbors + 1}) {
    HostOptions options;
    options.surface_neighbors = neighbors;
    EXPECT_THROW(HostMap{options}, std::invalid_argument) << neighbors;
  }
  HostOptions options;
  options.reach = -1.0;
  EXPECT_THROW(HostMap{options}, std::invalid_argument);
  HostOptions with_column;
  with_column.map.columns.intensity = true;
  EXPECT_THROW(HostMap{with_column}, std::invalid_argument);
}

}  // namespace
}  // namespace nvm
