// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What points carry beside stays with them, whatever is done to the map; and changes nothing else.
#include "nvm/map/point_values.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "map/random_operation.hpp"
#include "nvm/map/map_archive.hpp"
#include "nvm/map/serialization.hpp"

namespace nvm {
namespace {

using test::Rng;

/// Values that no other point has, and which tell its number.
PointValues numbered(std::size_t i) {
  PointValues values;
  values.intensity = 0.5F * static_cast<float>(i);
  values.time = 1e9 + 0.001 * static_cast<double>(i);
  values.color = {
      static_cast<std::uint8_t>(i),
      static_cast<std::uint8_t>(i >> 8U),
      static_cast<std::uint8_t>(i >> 16U)};
  values.label = static_cast<std::uint16_t>(i);
  return values;
}

void expect_values(const PointValues& values, std::size_t i, const MapColumns& columns) {
  const PointValues expected = numbered(i);
  EXPECT_EQ(values.intensity, columns.intensity ? expected.intensity : 0.0F);
  EXPECT_EQ(values.time, columns.time ? expected.time : 0.0);
  EXPECT_EQ(values.color.red, columns.color ? expected.color.red : 0);
  EXPECT_EQ(values.color.green, columns.color ? expected.color.green : 0);
  EXPECT_EQ(values.color.blue, columns.color ? expected.color.blue : 0);
  EXPECT_EQ(values.label, columns.label ? expected.label : 0);
}

/// A map, and all points that were ever given to it. Each lies in a place of its own, so that a
/// stored one tells which it is; half of them are sightings, which later points settle.
class NumberedPoints {
 public:
  void insert_some(VoxelMap& map, Rng& rng) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3f> normals;
    std::vector<PointValues> values;
    for (int i = 0; i < 300; ++i) {
      points.push_back(2.0 * test::random_unit(rng).cast<double>());
      normals.push_back((rng() % 2 == 0 ? 1.0F : 0.5F) * test::random_unit(rng));
      values.push_back(numbered(all_.size()));
      all_.push_back(points.back());
    }
    map.insert(points, normals, Pose::Identity(), values);
  }

  /// That every point of the map has its own values, also those that a query finds.
  void expect_own_values(const VoxelMap& map) const {
    VoxelMap::QueryContext context;
    map.for_each_point([&](const MapPoint& point) {
      expect_values(point.values, nearest(point.position), map.options().columns);
      Neighbor found;
      ASSERT_EQ(map.nearest(point.position, {1, 0.1}, &found, context), 1U);
      expect_values(map.values(found.id), nearest(found.position), map.options().columns);
    });
  }

 private:
  std::size_t nearest(const Eigen::Vector3d& position) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < all_.size(); ++i) {
      best = (all_[i] - position).norm() < (all_[best] - position).norm() ? i : best;
    }
    return best;
  }

  std::vector<Eigen::Vector3d> all_;
};

MapOptions options_with(unsigned columns) {
  MapOptions options;
  unsigned bit = 1;
  visit_columns([&](const OptionInfo&, auto kept, auto) {
    options.columns.*kept = (columns & bit) != 0;
    bit <<= 1U;
  });
  options.capacity = 200;  // so that voxels are evicted
  options.min_point_distance = 0.05;
  return options;
}

class Columns : public testing::TestWithParam<unsigned> {};

TEST_P(Columns, StayWithTheirPoints) {
  Rng rng = test::rng();
  VoxelMap map(options_with(GetParam()));
  NumberedPoints points;
  for (int round = 0; round < 4; ++round) {
    points.insert_some(map, rng);
    map.erase_within(2.0 * test::random_unit(rng).cast<double>(), 0.7);
  }
  ASSERT_GT(map.size(), 150U);
  points.expect_own_values(map);
  points.expect_own_values(MapArchive::read(MapArchive::write(map)));
  const std::string path = testing::TempDir() + "nvm_columns_" + std::to_string(GetParam());
  save_map_image(map, path);
  VoxelMap mapped = load_map(path);
  std::remove(path.c_str());
  points.expect_own_values(mapped);
  points.insert_some(mapped, rng);
  points.expect_own_values(mapped);
}

INSTANTIATE_TEST_SUITE_P(All, Columns, testing::Range(0U, 16U));

TEST(ColumnsOfAMap, ChangeNothingElse) {
  Rng rng = test::rng();
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    MapOptions options = test::random_options(rng);
    options.max_bytes = 0;  // of which values take their share
    VoxelMap bare(options);
    options.columns.label = true;
    options.columns.time = true;
    VoxelMap map(options);
    for (int i = 0; i < 12; ++i) {
      const test::RandomOperation operation(options, rng);
      operation(bare);
      operation(map);
    }
    const std::vector<MapPoint> expected = bare.points();
    const std::vector<MapPoint> points = map.points();
    ASSERT_EQ(points.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(points[i].position, expected[i].position);
      ASSERT_EQ(points[i].normal, expected[i].normal);
      ASSERT_EQ(points[i].side, expected[i].side);
      ASSERT_EQ(points[i].values.label, 0) << "of points that came without";
    }
    ASSERT_LE(map.memory_bytes(), map.memory_limit_bytes());
  }
}

TEST(ColumnsOfAMap, MustBeAsManyAsPoints) {
  VoxelMap map;
  const std::vector<Eigen::Vector3d> points(3, Eigen::Vector3d::Ones());
  const std::vector<Eigen::Vector3f> normals(3, Eigen::Vector3f::UnitX());
  const std::vector<PointValues> values(2);
  EXPECT_THROW(map.insert(points, normals, Pose::Identity(), values), std::invalid_argument);
  EXPECT_THROW(map.insert_unsided(points, Pose::Identity(), values), std::invalid_argument);
  EXPECT_TRUE(map.empty());
}

TEST(ColumnsOfAMap, AreKeptWithoutNormalsToo) {
  VoxelMap map(options_with(15));
  map.insert_unsided(
      std::vector<Eigen::Vector3d>{{1, 2, 3}}, Pose::Identity(), std::vector{numbered(70'000)});
  ASSERT_EQ(map.size(), 1U);
  expect_values(map.points().front().values, 70'000, map.options().columns);
}

TEST(ColumnsOfAMap, CountInItsLimit) {
  MapOptions options;
  options.capacity = 1000;
  const std::size_t bare = VoxelMap(options).memory_limit_bytes();
  options.columns.label = true;
  // 2 surfaces of 20 points, in chunks of 8.
  EXPECT_EQ(VoxelMap(options).memory_limit_bytes() - bare, 1000U * 2 * 24 * 2);
}

// version_3.map was written by the last nvm that wrote version 3: three voxels, whose points have
// been merged with others 4 mm above the first.
TEST(ColumnsOfAMap, AreNoneInVersion3) {
  std::ifstream file(NVM_SOURCE_DIR "/tests/map/golden/version_3.map", std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  ASSERT_EQ(bytes.size(), 446U);
  const VoxelMap map = MapArchive::read(bytes);
  EXPECT_EQ(map.size(), 27U);
  EXPECT_EQ(map.options().max_merged_points, 4);
  EXPECT_EQ(map.options().eviction_radius, 42.0);
  EXPECT_FALSE(map.options().columns.intensity);
  const std::vector<MapPoint> points = map.points();
  EXPECT_NEAR(points[0].position.z(), 0.202, 1e-4);
  EXPECT_NEAR(points[2].position.z(), 0.2, 1e-4);
  EXPECT_EQ(MapArchive::read(MapArchive::write(map)).size(), map.size());
}

// version_4.map was written by the first nvm that wrote version 4: points numbered from 0 on, as
// they were inserted.
TEST(ColumnsOfAMap, AreReadFromVersion4) {
  std::ifstream file(NVM_SOURCE_DIR "/tests/map/golden/version_4.map", std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  const VoxelMap map = MapArchive::read(bytes);
  EXPECT_EQ(map.size(), 27U);
  map.for_each_point([](const MapPoint& point) {
    const int number = point.values.label - 1000;
    EXPECT_NEAR(point.position.x(), 0.5 * (number / 12) + 0.04 * (number % 6) + 0.02, 1e-4);
    EXPECT_NEAR(point.position.y(), 0.1 * (number % 12 / 6) + 0.05, 1e-4);
    EXPECT_EQ(point.values.intensity, 0.5F * static_cast<float>(number));
    EXPECT_NEAR(point.values.time, 1e9 + 0.001 * number, 1e-6);
    EXPECT_EQ(point.values.color.red, number);
    EXPECT_EQ(point.values.color.green, 200);
    EXPECT_EQ(point.values.color.blue, 255);
  });
  EXPECT_EQ(MapArchive::write(map), bytes);
}

}  // namespace
}  // namespace nvm
