// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Whatever is done to a map, it can be saved, and the loaded one is the same: byte by byte when it
// is saved again, and after whatever is done to both of them from then on.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>

#include "map/random_operation.hpp"
#include "nvm/map/map_archive.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using test::RandomOperation;
using test::Rng;
using Bytes = std::vector<std::uint8_t>;

/// Both maps agree on where each point of `map` is.
void expect_points_in_place(const VoxelMap& map) {
  VoxelMap::QueryContext context;
  std::size_t points = 0;
  map.for_each_point([&](const MapPoint& point) {
    Neighbor found;
    ASSERT_EQ(map.nearest(point.position, {1, 1e-6}, &found, context), 1U);
    ASSERT_EQ(map.position(found.id), found.position);
    ++points;
  });
  ASSERT_EQ(points, map.size());
}

TEST(Archive, LoadsWhateverIsSavedAndGoesOnAsTheSame) {
  Rng rng = test::rng();
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    const MapOptions options = test::random_options(rng);
    VoxelMap map(options);
    for (int i = 0; i < 12; ++i) {
      RandomOperation(options, rng)(map);
    }
    const Bytes bytes = MapArchive::write(map);
    VoxelMap loaded = MapArchive::read(bytes);
    ASSERT_EQ(MapArchive::write(loaded), bytes);
    expect_points_in_place(VoxelMap(MapArchive::read(bytes)));
    for (int i = 0; i < 8; ++i) {
      const RandomOperation operation(options, rng);
      operation(map);
      operation(loaded);
      ASSERT_EQ(MapArchive::write(loaded), MapArchive::write(map)) << "operation " << i;
    }
  }
}

// The ring of epochs has 1024 entries: both are renumbered at the same time.
TEST(Archive, TheOrderOfUseOutlivesManyEpochs) {
  Rng rng = test::rng();
  MapOptions options;
  options.capacity = 40;
  VoxelMap map(options);
  VoxelMap loaded(options);
  for (int step = 0; step < 4000; ++step) {
    if (step % 700 == 650) {
      const Bytes bytes = MapArchive::write(map);
      loaded = MapArchive::read(bytes);
    }
    const double x = 0.15 + 0.3 * static_cast<double>(rng() % 60);
    for (VoxelMap* each : {&map, &loaded}) {
      each->insert(
          std::vector<Eigen::Vector3d>{{x, 0.15, 0.15}},
          std::vector<Eigen::Vector3f>{{0.0F, 0.0F, 1.0F}});
      VoxelMap::QueryContext context;
      std::array<Neighbor, 5> found;
      each->nearest({0.15 + step % 15, 0.15, 0.15}, {5, 0.5}, found.data(), context);
    }
    if (step > 650) {
      ASSERT_EQ(MapArchive::write(loaded), MapArchive::write(map)) << step;
    }
  }
}

TEST(Archive, SpaceAcrossVoxelsLeavesNoEmptyVoxelAndNoEmptySurface) {
  MapOptions options;
  options.space_across_voxels = true;
  VoxelMap map(options);
  const std::vector<Eigen::Vector3f> normals{{0, 0, 1}, {0, 0, 1}};
  const InsertStats stats =
      map.insert(std::vector<Eigen::Vector3d>{{0.299, 0.1, 0.1}, {0.301, 0.1, 0.1}}, normals);
  EXPECT_EQ(stats.too_close, 1U);
  EXPECT_EQ(stats.new_voxels, 1U);
  EXPECT_EQ(map.voxel_count(), 1U);
  // A back surface beside a back point of the next voxel.
  map.insert(std::vector<Eigen::Vector3d>{{0.45, 0.1, 0.1}, {0.301, 0.2, 0.1}}, normals);
  const std::vector<Eigen::Vector3f> back{{0, 0, -1}, {0, 0, -1}};
  map.insert(std::vector<Eigen::Vector3d>{{0.299, 0.25, 0.1}, {0.301, 0.25, 0.1}}, back);
  EXPECT_EQ(map.stats().surfaces, 3U);
  EXPECT_EQ(MapArchive::read(MapArchive::write(map)).size(), map.size());
}

// version_2.map was written by the last nvm that wrote version 2: three voxels of 12 points each,
// every fourth of which faces the other way, and a query after the last of them.
TEST(Archive, ReadsVersion2) {
  std::ifstream file(NVM_SOURCE_DIR "/tests/map/golden/version_2.map", std::ios::binary);
  const Bytes bytes{std::istreambuf_iterator<char>(file), {}};
  ASSERT_EQ(bytes.size(), 492U);
  VoxelMap map = MapArchive::read(bytes);
  EXPECT_EQ(map.size(), 36U);
  EXPECT_EQ(map.stats().surfaces, 6U);
  EXPECT_EQ(map.options().max_merged_points, 1);
  EXPECT_EQ(map.options().points_per_surface, 9);
  EXPECT_EQ(map.options().surface_rule, SurfaceRule::kSmallestAngle);
  EXPECT_EQ(map.options().eviction_radius, 42.0);
  EXPECT_FALSE(map.options().columns.time);
  std::size_t of_first_voxel = 0;
  map.for_each_within({0.22, -100.25, 7.1}, 0.23, [&](const Neighbor&) { ++of_first_voxel; });
  EXPECT_EQ(of_first_voxel, 12U);
  // The first voxel was asked last: the second is the oldest.
  map.insert(
      std::vector<Eigen::Vector3d>{{9.0, 0.0, 0.0}}, std::vector<Eigen::Vector3f>{{0, 0, 1}});
  Neighbor found;
  VoxelMap::QueryContext context;
  EXPECT_EQ(map.nearest({0.72, -100.25, 7.1}, {1, 0.1}, &found, context), 0U);
  EXPECT_EQ(map.nearest({0.22, -100.25, 7.1}, {1, 0.1}, &found, context), 1U);
  EXPECT_EQ(MapArchive::read(MapArchive::write(map)).size(), map.size());
}

TEST(VoxelMap, IsEmptyAndUsableAfterItWasMovedFrom) {
  Rng rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(1000, 2.0, Eigen::Vector3d::Zero(), rng);
  MapOptions options;
  options.max_merged_points = 3;
  VoxelMap map(options);
  map.insert(cloud.points, cloud.normals);
  const std::size_t size = map.size();
  const Bytes bytes = MapArchive::write(map);
  VoxelMap taken(std::move(map));
  EXPECT_EQ(MapArchive::write(taken), bytes);
  // NOLINTBEGIN(bugprone-use-after-move): that is what it is about
  EXPECT_EQ(map.size(), 0U);
  EXPECT_EQ(map.voxel_count(), 0U);
  EXPECT_TRUE(map.points().empty());
  EXPECT_EQ(map.stats().surfaces, 0U);
  EXPECT_EQ(map.erase_within({0, 0, 0}, 5.0) + map.erase_voxels_beyond({9, 0, 0}, 1.0), 0U);
  VoxelMap::QueryContext context;
  Neighbor found;
  EXPECT_EQ(map.nearest(cloud.points[0], {1, 1.0}, &found, context), 0U);
  EXPECT_TRUE(MapArchive::read(MapArchive::write(map)).empty());
  map.clear();
  EXPECT_EQ(map.insert(cloud.points, cloud.normals).stored, size);
  EXPECT_EQ(MapArchive::write(map), bytes);
  // NOLINTEND(bugprone-use-after-move)
  taken = std::move(map);
  EXPECT_EQ(taken.size(), size);
  VoxelMap& same = taken;
  taken = std::move(same);
  EXPECT_EQ(MapArchive::write(taken), bytes);
}

}  // namespace
}  // namespace nvm
