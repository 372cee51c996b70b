// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// A map that is mapped from its image is the map that was saved, also in what becomes of it; and
// the file stays as it is. Damage is found.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "map/random_operation.hpp"
#include "nvm/map/map_archive.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm {
namespace {

using test::RandomOperation;
using test::Rng;

class MapImageTest : public testing::Test {
 protected:
  std::string contents() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  }
  std::string problem() const {
    try {
      load_map(path_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  void TearDown() override { std::remove(path_.c_str()); }

  std::string path_ = testing::TempDir() + "nvm_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".image";
};

TEST_F(MapImageTest, IsTheMapAndGoesOnAsTheSame) {
  Rng rng = test::rng();
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    const MapOptions options = test::random_options(rng);
    VoxelMap map(options);
    for (int i = 0; i < 12; ++i) {
      RandomOperation(options, rng)(map);
    }
    save_map_image(map, path_);
    const std::string bytes = contents();
    VoxelMap mapped = load_map(path_);
    ASSERT_EQ(MapArchive::write(mapped), MapArchive::write(map));
    ASSERT_EQ(mapped.memory_bytes(), map.memory_bytes());
    for (int i = 0; i < 8; ++i) {
      const RandomOperation operation(options, rng);
      operation(map);
      operation(mapped);
      ASSERT_EQ(MapArchive::write(mapped), MapArchive::write(map)) << "operation " << i;
    }
    ASSERT_EQ(contents(), bytes);
  }
}

TEST_F(MapImageTest, FindsDamageAnywhere) {
  Rng rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(500, 2.0, Eigen::Vector3d::Zero(), rng);
  MapOptions options;
  options.max_merged_points = 3;
  options.capacity = 500;
  VoxelMap map(options);
  map.insert(cloud.points, cloud.normals);
  save_map_image(map, path_);
  const std::string whole = contents();
  ASSERT_EQ(problem(), "");
  constexpr std::size_t kHeaderSize = 40;
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    const std::size_t place =
        i < 40 ? static_cast<std::size_t>(i)
               : detail::kImagePage + rng() % (whole.size() - detail::kImagePage);
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << rng() % 8));
    write(damaged);
    EXPECT_NE(problem(), "") << "byte " << place;
  }
  for (const std::size_t size :
       {std::size_t{0}, kHeaderSize, detail::kImagePage, whole.size() / 2, whole.size() - 1}) {
    write(whole.substr(0, size));
    EXPECT_NE(problem(), "") << size << " bytes";
  }
  write(whole + std::string(detail::kImagePage, '\0'));
  EXPECT_NE(problem(), "");
}

TEST_F(MapImageTest, IsToldFromAMapFile) {
  VoxelMap map;
  map.insert(std::vector<Eigen::Vector3d>{{1, 2, 3}}, std::vector<Eigen::Vector3f>{{0, 0, 1}});
  save_map(map, path_);
  const std::size_t size_of_file = contents().size();
  EXPECT_EQ(load_map(path_).size(), 1U);
  save_map_image(map, path_);
  EXPECT_GT(contents().size(), size_of_file);
  EXPECT_EQ(load_map(path_).size(), 1U);
  EXPECT_THROW(save_map_image(map, path_ + "/no/such/folder"), std::runtime_error);
}

TEST_F(MapImageTest, OutlivesItsFileAndIsEmptyWhenMovedFrom) {
  VoxelMap map;
  save_map_image(map, path_);
  EXPECT_TRUE(load_map(path_).empty());
  map.insert(std::vector<Eigen::Vector3d>{{1, 2, 3}}, std::vector<Eigen::Vector3f>{{0, 0, 1}});
  save_map_image(map, path_);
  VoxelMap mapped = load_map(path_);
  save_map_image(VoxelMap(), path_);  // takes the file's place
  EXPECT_EQ(mapped.size(), 1U);
  VoxelMap taken = std::move(mapped);
  EXPECT_EQ(taken.size(), 1U);
  taken.clear();
  EXPECT_TRUE(taken.empty());
}

}  // namespace
}  // namespace nvm
