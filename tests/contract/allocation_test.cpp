// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <random>
#include <vector>

#include "nvm/map/voxel_map.hpp"
#include "nvm/normal/normal_estimator.hpp"
#include "support/rng.hpp"

namespace {
std::size_t allocation_count = 0;
}  // namespace

// Counts every allocation of this program.
void* operator new(std::size_t size) {
  ++allocation_count;
  if (void* memory = std::malloc(size)) {
    return memory;
  }
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocation_count;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) {
    return memory;
  }
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace nvm::test {
namespace {

struct Cloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3f> normals;
};

/// `size` points with random normals in a box with edges of 2 m around `center`.
Cloud random_cloud(std::size_t size, const Eigen::Vector3d& center, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto draw = [&] {
    return Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  };
  Cloud cloud;
  for (std::size_t i = 0; i < size; ++i) {
    cloud.points.push_back(center + draw());
    cloud.normals.push_back(draw().normalized().cast<float>());
  }
  return cloud;
}

template <class Action>
std::size_t allocations_in(const Action& action) {
  const std::size_t before = allocation_count;
  action();
  return allocation_count - before;
}

TEST(Contract, TheCounterSeesAnAllocation) {
  EXPECT_EQ(
      allocations_in([] { std::vector<int>(10).swap(*std::make_unique<std::vector<int>>()); }), 2U);
}

TEST(Contract, QueriesAllocateNothing) {
  auto random = rng();
  VoxelMap map;
  const Cloud cloud = random_cloud(20'000, Eigen::Vector3d::Zero(), random);
  map.insert(cloud.points, cloud.normals);
  const Cloud queries = random_cloud(1'000, Eigen::Vector3d(0.5, 0.0, 0.0), random);

  std::size_t found = 0;
  const std::size_t allocations = allocations_in([&] {
    VoxelMap::QueryContext context;
    std::array<Neighbor, kMaxNeighbors> neighbors;
    for (std::size_t i = 0; i < queries.points.size(); ++i) {
      const NearestSearch search{1 + i % kMaxNeighbors, 0.5};
      found +=
          map.nearest(queries.points[i], queries.normals[i], search, neighbors.data(), context);
      found += map.nearest(queries.points[i], search, neighbors.data(), context);
      map.for_each_within(queries.points[i], 0.3, [&](const Neighbor&) { ++found; });
    }
  });
  EXPECT_GT(found, queries.points.size());
  EXPECT_EQ(allocations, 0U);
}

TEST(Contract, AFullMapAllocatesNothing) {
  auto random = rng();
  MapOptions options;
  options.capacity = 200;
  VoxelMap map(options);
  const auto insert_along_path = [&](double begin, double end) {
    std::size_t allocations = 0;
    for (double x = begin; x < end; x += 1.0) {
      const Cloud cloud = random_cloud(500, Eigen::Vector3d(x, 0.0, 0.0), random);
      allocations += allocations_in([&] { map.insert(cloud.points, cloud.normals); });
    }
    return allocations;
  };
  insert_along_path(0.0, 50.0);
  ASSERT_EQ(map.voxel_count(), options.capacity);
  EXPECT_EQ(insert_along_path(50.0, 100.0), 0U);
}

TEST(Contract, AnEstimatorAllocatesNothingAfterTheFirstScan) {
  auto random = rng();
  const Cloud cloud = random_cloud(20'000, Eigen::Vector3d(3.0, 0.0, 0.0), random);
  for (const NormalMethod method : {NormalMethod::kBlockTree, NormalMethod::kPerCell}) {
    NormalOptions options;
    options.method = method;
    NormalEstimator estimator(options);
    const Eigen::Vector3d viewpoint(0.0, 0.0, 0.0);
    estimator.estimate(cloud.points, viewpoint);
    EXPECT_EQ(allocations_in([&] { estimator.estimate(cloud.points, viewpoint); }), 0U);
  }
}

}  // namespace
}  // namespace nvm::test
