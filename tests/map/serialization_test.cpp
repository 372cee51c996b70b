// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/map/serialization.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

VoxelMap sample_map(std::mt19937_64& rng, std::size_t capacity = 800) {
  MapOptions options;
  options.capacity = capacity;
  options.voxel_size = 0.4;
  options.max_surfaces = 3;
  VoxelMap map(options);
  for (int scan = 0; scan < 5; ++scan) {
    const test::Cloud cloud = test::uniform_cloud(3000, 4.0, {scan * 0.5, -1e3, 0}, rng);
    map.insert(cloud.points, cloud.normals);
    VoxelMap::QueryContext context;
    std::array<Neighbor, 5> found;
    map.nearest(cloud.points[0], {5, 1.0, Gate::kSurfaces}, found.data(), context);
  }
  return map;
}

TEST(Serialization, GivesBackTheSameMap) {
  std::mt19937_64 rng = test::rng();
  VoxelMap map = sample_map(rng);
  const std::vector<std::uint8_t> bytes = MapArchive::write(map);
  VoxelMap loaded = MapArchive::read(bytes);
  EXPECT_EQ(MapArchive::write(loaded), bytes);
  EXPECT_EQ(loaded.size(), map.size());
  EXPECT_EQ(loaded.voxel_count(), map.voxel_count());
  EXPECT_EQ(loaded.stats().two_sided_voxels, map.stats().two_sided_voxels);

  // Both evict the same voxels and answer alike from here on.
  for (int scan = 0; scan < 10; ++scan) {
    const test::Cloud cloud = test::uniform_cloud(500, 6.0, {scan * 0.5, -1e3, 0}, rng);
    const InsertStats a = map.insert(cloud.points, cloud.normals);
    const InsertStats b = loaded.insert(cloud.points, cloud.normals);
    ASSERT_EQ(a.stored, b.stored);
    ASSERT_EQ(a.evicted_points, b.evicted_points);
    VoxelMap::QueryContext context_a;
    VoxelMap::QueryContext context_b;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      std::array<Neighbor, 5> found_a;
      std::array<Neighbor, 5> found_b;
      const NearestSearch search{5, 1.0, Gate::kSurfaces};
      const std::size_t count =
          map.nearest(cloud.points[i], cloud.normals[i], search, found_a.data(), context_a);
      ASSERT_EQ(
          loaded.nearest(cloud.points[i], cloud.normals[i], search, found_b.data(), context_b),
          count);
      for (std::size_t j = 0; j < count; ++j) {
        ASSERT_EQ(found_a[j].sq_distance, found_b[j].sq_distance);
        ASSERT_EQ(found_a[j].position, found_b[j].position);
      }
    }
  }
  EXPECT_EQ(MapArchive::write(map), MapArchive::write(loaded));
}

TEST(Serialization, AnEmptyMapIsAMap) {
  EXPECT_TRUE(MapArchive::read(MapArchive::write(VoxelMap())).empty());
}

TEST(Serialization, RefusesEveryTruncationAndEveryFlippedByte) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.capacity = 100;
  VoxelMap map(options);
  const test::Cloud cloud = test::uniform_cloud(20, 1.0, Eigen::Vector3d::Zero(), rng);
  map.insert(cloud.points, cloud.normals);
  const std::vector<std::uint8_t> bytes = MapArchive::write(map);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(
        MapArchive::read({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}),
        std::runtime_error);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::uint8_t> corrupt = bytes;
    corrupt[i] = static_cast<std::uint8_t>(corrupt[i] ^ (1U << rng() % 8));
    EXPECT_THROW(MapArchive::read(corrupt), std::runtime_error);
  }
}

// A forged file has a right checksum: the content must be checked too.
TEST(Serialization, RefusesForgedContent) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.capacity = 100;
  VoxelMap map(options);
  const test::Cloud cloud = test::uniform_cloud(200, 1.0, Eigen::Vector3d::Zero(), rng);
  map.insert(cloud.points, cloud.normals);
  const std::vector<std::uint8_t> bytes = MapArchive::write(map);
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::uint8_t> forged = bytes;
    const std::size_t at =
        28 + rng() % (bytes.size() - 32);  // any byte of the body but the huge capacity's
    if (at < 44) {
      continue;
    }
    forged[at] = static_cast<std::uint8_t>(rng());
    const std::uint32_t crc = detail::crc32(forged.data(), forged.size() - 4);
    for (std::size_t i = 0; i < 4; ++i) {
      forged[forged.size() - 4 + i] = static_cast<std::uint8_t>(crc >> 8 * i);
    }
    try {
      const VoxelMap loaded = MapArchive::read(forged);
      EXPECT_EQ(loaded.size(), loaded.points().size());
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(Serialization, FilesNameThemselvesInErrors) {
  std::mt19937_64 rng = test::rng();
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "nvm_serialization_test";
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "a.nvm").string();
  const VoxelMap map = sample_map(rng);
  save_map(map, path);
  EXPECT_EQ(MapArchive::write(load_map(path)), MapArchive::write(map));
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));

  const auto message = [](const std::string& file) {
    try {
      load_map(file);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("loaded");
  };
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  EXPECT_THAT(message((folder / "none.nvm").string()), HasSubstr("none.nvm: cannot be opened"));
  std::ofstream(folder / "foreign.nvm") << "# .PCD v0.7 - Point Cloud Data file format, not a map";
  EXPECT_THAT(
      message((folder / "foreign.nvm").string()),
      AllOf(HasSubstr("foreign.nvm"), HasSubstr("is not an nvm map")));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 7);
  EXPECT_THAT(message(path), HasSubstr("truncated"));
  EXPECT_THROW(save_map(map, (folder / "no" / "such" / "folder.nvm").string()), std::runtime_error);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace nvm
