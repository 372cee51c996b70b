// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/keypoints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "support/rng.hpp"

namespace nvm::lio {
namespace {

struct Cloud {
  std::vector<Eigen::Vector3f> points, normals;
};

Cloud random_cloud(std::size_t size) {
  auto generator = test::rng();
  std::uniform_real_distribution<float> uniform(-3.0F, 3.0F);
  Cloud cloud;
  for (std::size_t i = 0; i < size; ++i) {
    cloud.points.emplace_back(uniform(generator), uniform(generator), uniform(generator));
    cloud.normals.emplace_back(i % 5 == 0 ? 0.0F : 1.0F, 0.0F, 0.0F);
  }
  return cloud;
}

TEST(KeypointSampler, TakesOnePointWithANormalPerCube) {
  const Cloud cloud = random_cloud(5000);
  KeypointSampler sampler({0.5, 100'000});
  std::set<std::tuple<int, int, int>> expected;
  const auto cube = [](const Eigen::Vector3f& p) {
    const auto index = [](float x) { return static_cast<int>(std::floor(x / 0.5F)); };
    return std::make_tuple(index(p.x()), index(p.y()), index(p.z()));
  };
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!cloud.normals[i].isZero()) {
      expected.insert(cube(cloud.points[i]));
    }
  }
  std::set<std::tuple<int, int, int>> found;
  for (const std::uint32_t i : sampler.sample(cloud.points, cloud.normals)) {
    EXPECT_FALSE(cloud.normals[i].isZero());
    EXPECT_TRUE(found.insert(cube(cloud.points[i])).second);
  }
  EXPECT_EQ(found, expected);
}

TEST(KeypointSampler, TakesASightingWhereNoPointHasANormal) {
  const std::vector<Eigen::Vector3f> points = {
      {0.1F, 0.1F, 0.1F}, {0.2F, 0.2F, 0.2F}, {1.1F, 0.1F, 0.1F}, {2.1F, 0.1F, 0.1F}};
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  const std::vector<Eigen::Vector3f> normals = {0.5F * up, up, 0.5F * up, Eigen::Vector3f::Zero()};
  KeypointSampler sampler({0.5, 100, 0});
  EXPECT_EQ(sampler.sample(points, normals), (std::vector<std::uint32_t>{1, 2}));
  KeypointSampler without({0.5, 100, 0, 0});
  EXPECT_EQ(without.sample(points, normals), (std::vector<std::uint32_t>{1}));
}

TEST(KeypointSampler, SpreadsALimitedNumberOverTheWholeScan) {
  const Cloud cloud = random_cloud(5000);
  KeypointSampler sampler({0.05, 500});
  const auto chosen = sampler.sample(cloud.points, cloud.normals);
  ASSERT_EQ(chosen.size(), 500U);
  double mean = 0.0;
  for (const std::uint32_t i : chosen) {
    mean += i / 500.0;
  }
  EXPECT_NEAR(mean, 2500.0, 150.0);
  EXPECT_EQ(chosen, sampler.sample(cloud.points, cloud.normals));
}

/// A square metre of wall has 9 cubes of a third of a metre, and is all that a sensor may see.
TEST(KeypointSampler, TakesMoreOfAScanThatShowsLittle) {
  Cloud wall = random_cloud(5000);
  for (Eigen::Vector3f& point : wall.points) {
    point = {0.65F, point.y() / 6.0F, point.z() / 6.0F};
  }
  const auto count = [&](std::size_t min_count, std::size_t max_count) {
    return KeypointSampler({0.34, max_count, min_count}).sample(wall.points, wall.normals).size();
  };
  EXPECT_LE(count(0, 1500), 16U);
  EXPECT_GE(count(100, 1500), 100U);
  EXPECT_LE(count(100, 1500), 256U);  // no more than it takes
  EXPECT_LE(count(100'000, 100'000), 1024U);
  EXPECT_EQ(count(100'000, 50), 50U);
}

TEST(KeypointSampler, AcceptsAnEmptyScan) {
  KeypointSampler sampler({});
  EXPECT_TRUE(sampler.sample({}, {}).empty());
}

TEST(KeypointSampler, RejectsBadOptions) {
  EXPECT_THROW(KeypointSampler({0.0, 100}), std::invalid_argument);
  EXPECT_THROW(KeypointSampler({0.1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace nvm::lio
