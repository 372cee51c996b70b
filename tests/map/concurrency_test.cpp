// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

#include "nvm/map/voxel_map.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

// Run under ThreadSanitizer: queries mark voxels as used while other queries do the same.
TEST(Concurrency, QueriesFromManyThreadsAgreeWithOneThread) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.capacity = 3000;
  VoxelMap map(options);
  for (int scan = 0; scan < 3; ++scan) {
    const test::Cloud cloud = test::uniform_cloud(4000, 4.0, {scan * 0.5, 0, 0}, rng);
    map.insert(cloud.points, cloud.normals);
    const auto ask = [&](std::size_t begin, std::vector<PointId>& ids) {
      VoxelMap::QueryContext context;
      std::array<Neighbor, 5> found;
      for (std::size_t i = begin; i < begin + 1000; ++i) {
        const std::size_t count = map.nearest(
            cloud.points[i], cloud.normals[i], {5, 1.0, Gate::kSurfaces}, found.data(), context);
        for (std::size_t j = 0; j < count; ++j) {
          ids.push_back(found[j].id);
        }
        map.for_each_within(cloud.points[i], 0.1, [&](const Neighbor& n) { ids.push_back(n.id); });
      }
    };
    std::array<std::vector<PointId>, 4> alone;
    std::array<std::vector<PointId>, 4> together;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
      ask(t * 500, alone[t]);  // overlapping ranges: the same voxels at the same time
    }
    for (std::size_t t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] { ask(t * 500, together[t]); });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
    EXPECT_EQ(alone, together);
  }
}

}  // namespace
}  // namespace nvm
