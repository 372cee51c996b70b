// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "nvm/core/executor_openmp.hpp"
#include "nvm/core/executor_tbb.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/voxel_map.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

/// Runs the blocks from the last to the first, which some thread of a real executor might.
struct BackwardExecutor {
  template <class Body>
  void for_blocks(std::size_t size, std::size_t grain, const Body& body) const {
    const detail::Blocks blocks(size, grain);
    for (std::size_t block = blocks.count(); block-- > 0;) {
      blocks.run(block, body);
      ++*blocks_run;
    }
  }
  std::size_t* blocks_run;
};

struct Setting {
  const char* name;
  std::function<void(MapOptions&)> change;
};

/// A room's worth of walls, edges and bad points, more than an insertion does in one thread.
test::Cloud messy_cloud(std::mt19937_64& rng) {
  test::Cloud cloud = test::thin_wall(60'000, 0.05, rng);
  const test::Cloud filling = test::uniform_cloud(20'000, 5.0, {0.3, 0.0, 0.1}, rng);
  cloud.points.insert(cloud.points.end(), filling.points.begin(), filling.points.end());
  cloud.normals.insert(cloud.normals.end(), filling.normals.begin(), filling.normals.end());
  std::vector<std::size_t> order(cloud.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::shuffle(order.begin(), order.end(), rng);
  test::Cloud mixed;
  for (const std::size_t i : order) {
    mixed.points.push_back(cloud.points[i]);
    mixed.normals.push_back(cloud.normals[i]);
  }
  for (std::size_t i = 0; i < mixed.points.size(); i += 997) {
    mixed.points[i].x() = std::numeric_limits<double>::quiet_NaN();
    mixed.points[i + 1].y() = 1e9;
    mixed.normals[i + 2].setZero();
  }
  return mixed;
}

void expect_equal(const InsertStats& a, const InsertStats& b) {
  EXPECT_EQ(a.stored, b.stored);
  EXPECT_EQ(a.too_close, b.too_close);
  EXPECT_EQ(a.surface_full, b.surface_full);
  EXPECT_EQ(a.no_normal, b.no_normal);
  EXPECT_EQ(a.non_finite, b.non_finite);
  EXPECT_EQ(a.out_of_range, b.out_of_range);
  EXPECT_EQ(a.map_full, b.map_full);
  EXPECT_EQ(a.new_voxels, b.new_voxels);
  EXPECT_EQ(a.evicted_voxels, b.evicted_voxels);
  EXPECT_EQ(a.evicted_points, b.evicted_points);
}

class ParallelInsertionTest : public ::testing::TestWithParam<Setting> {
 protected:
  MapOptions options() const {
    MapOptions options;
    GetParam().change(options);
    return options;
  }

  /// A walk past the same walls: the first clouds fill the map, the later ones are mostly rejected.
  template <class Executor>
  void expect_same_as_serial(const Executor& executor) {
    std::mt19937_64 rng = test::rng();
    VoxelMap serial(options());
    VoxelMap parallel(options());
    for (int step = 0; step < 3; ++step) {
      const test::Cloud cloud = messy_cloud(rng);
      const Pose pose(Eigen::Translation3d(0.3 * step, 0.0, 0.01 * step));
      expect_equal(
          serial.insert(cloud.points, cloud.normals, pose),
          parallel.insert(cloud.points, cloud.normals, pose, executor));
      ASSERT_EQ(MapArchive::write(serial), MapArchive::write(parallel)) << "step " << step;
    }
    const test::Cloud cloud = messy_cloud(rng);
    expect_equal(
        serial.insert_unsided(cloud.points),
        parallel.insert_unsided(cloud.points, Pose::Identity(), executor));
    EXPECT_EQ(MapArchive::write(serial), MapArchive::write(parallel));
  }
};

TEST_P(ParallelInsertionTest, BlocksInAnyOrder) {
  std::size_t blocks_run = 0;
  expect_same_as_serial(BackwardExecutor{&blocks_run});
  // Where voxels leave or points move, each point depends on all those before it.
  EXPECT_EQ(blocks_run == 0, options().capacity < 1000 || options().max_merged_points > 1);
}

TEST_P(ParallelInsertionTest, Tbb) { expect_same_as_serial(TbbExecutor()); }

#ifndef NVM_THREAD_SANITIZER  // which does not see the synchronisation inside libgomp
TEST_P(ParallelInsertionTest, OpenMp) { expect_same_as_serial(OpenMpExecutor()); }
#endif

INSTANTIATE_TEST_SUITE_P(
    Settings,
    ParallelInsertionTest,
    ::testing::Values(
        Setting{"Default", [](MapOptions&) {}},
        Setting{
            "SmallestAngle",
            [](MapOptions& o) {
              o.surface_rule = SurfaceRule::kSmallestAngle;
              o.max_surfaces = 3;
              o.max_surface_angle = 1.0;
            }},
        Setting{"SmallSurfaces", [](MapOptions& o) { o.points_per_surface = 5; }},
        Setting{"Dense", [](MapOptions& o) { o.min_point_distance = 0.0; }},
        Setting{"Merging", [](MapOptions& o) { o.max_merged_points = 8; }},
        Setting{"Capacity", [](MapOptions& o) { o.capacity = 500; }},
        Setting{"SpaceAcrossVoxels", [](MapOptions& o) { o.space_across_voxels = true; }}),
    [](const auto& setting) { return setting.param.name; });

// A map may fill up in the middle of a cloud: what is left is inserted in one thread.
TEST(ParallelInsertion, UpToTheCapacity) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.capacity = 40'000;
  const test::Cloud cloud = test::uniform_cloud(100'000, 20.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap serial(options);
  VoxelMap parallel(options);
  std::size_t blocks_run = 0;
  const InsertStats stats = serial.insert(cloud.points, cloud.normals);
  EXPECT_GT(stats.evicted_voxels, 1000U);
  expect_equal(
      stats,
      parallel.insert(
          cloud.points, cloud.normals, Pose::Identity(), BackwardExecutor{&blocks_run}));
  EXPECT_GT(blocks_run, 0U);
  EXPECT_EQ(MapArchive::write(serial), MapArchive::write(parallel));
}

TEST(ParallelInsertion, SplitsNothingUnderAMillisecond) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::thin_wall(60'000, 0.05, rng);
  VoxelMap map;
  std::size_t blocks_run = 0;
  map.insert(cloud.points, cloud.normals, Pose::Identity(), BackwardExecutor{&blocks_run});
  EXPECT_EQ(blocks_run, 0U);
}

}  // namespace
}  // namespace nvm
