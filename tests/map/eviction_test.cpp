// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "nvm/map/map_archive.hpp"
#include "nvm/map/voxel_map.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Normals = std::vector<Eigen::Vector3f>;

Eigen::Vector3d center_of(int voxel) { return {0.3 * voxel + 0.15, 0.15, 0.15}; }

/// What spec §3.5 says, written down naively: each voxel's time of last use; the smallest goes.
class LruModel {
 public:
  explicit LruModel(std::size_t capacity) : capacity_(capacity) {}

  void insert(int voxel) {
    if (last_use_.count(voxel) == 0 && last_use_.size() == capacity_) {
      last_use_.erase(
          std::min_element(last_use_.begin(), last_use_.end(), [](const auto& a, const auto& b) {
            return a.second < b.second;
          }));
    }
    last_use_[voxel] = ++now_;
  }
  void answer(int voxel) { last_use_[voxel] = ++now_; }
  bool holds(int voxel) const { return last_use_.count(voxel) != 0; }
  std::size_t size() const { return last_use_.size(); }

 private:
  std::size_t capacity_;
  std::map<int, long> last_use_;
  long now_ = 0;
};

// One use per epoch, so that the order is total: at most one query between two insertions.
TEST(Lru, EqualsTheModelStepByStep) {
  std::mt19937_64 rng = test::rng();
  for (const std::size_t capacity : {1UL, 2UL, 7UL, 100UL}) {
    MapOptions options;
    options.capacity = capacity;
    VoxelMap map(options);
    LruModel model(capacity);
    const auto voxels = static_cast<int>(3 * capacity);
    VoxelMap::QueryContext context;
    for (int step = 0; step < 8000; ++step) {
      const int voxel = static_cast<int>(rng() % static_cast<unsigned>(voxels));
      map.insert(Points{center_of(voxel)}, Normals{Eigen::Vector3f::UnitX()});
      model.insert(voxel);
      const int asked = static_cast<int>(rng() % static_cast<unsigned>(voxels));
      Neighbor found;
      const std::size_t count =
          map.nearest(center_of(asked), {1, 0.1, Gate::kSurfaces}, &found, context);
      ASSERT_EQ(count == 1, model.holds(asked)) << "step " << step;
      if (count == 1) {
        model.answer(asked);
      }
      ASSERT_EQ(map.voxel_count(), model.size());
    }
  }
}

TEST(Lru, SurvivesManyMoreEpochsThanVoxels) {
  MapOptions options;
  options.capacity = 10;
  VoxelMap map(options);
  LruModel model(10);
  std::mt19937_64 rng = test::rng();
  for (int step = 0; step < 50000; ++step) {  // the ring of epochs has 1024 entries
    const int voxel = rng() % 100 == 0 ? static_cast<int>(rng() % 30) : static_cast<int>(rng() % 3);
    map.insert(Points{center_of(voxel)}, Normals{Eigen::Vector3f::UnitX()});
    model.insert(voxel);
  }
  for (int voxel = 0; voxel < 30; ++voxel) {
    VoxelMap::QueryContext context;
    Neighbor found;
    EXPECT_EQ(
        map.nearest(center_of(voxel), {1, 0.1, Gate::kSurfaces}, &found, context) == 1,
        model.holds(voxel));
  }
}

TEST(Lru, QueriesThatFindNothingInAVoxelDoNotUseIt) {
  MapOptions options;
  options.capacity = 2;
  VoxelMap map(options);
  VoxelMap::QueryContext context;
  Neighbor found;
  map.insert(Points{center_of(0)}, Normals{Eigen::Vector3f::UnitX()});
  map.insert(Points{center_of(5)}, Normals{Eigen::Vector3f::UnitX()});
  // Voxel 0 is looked at but its point faces the other way.
  EXPECT_EQ(
      map.nearest(
          center_of(0), -Eigen::Vector3f::UnitX(), {1, 1.0, Gate::kSurfaces}, &found, context),
      0U);
  map.insert(Points{center_of(10)}, Normals{Eigen::Vector3f::UnitX()});
  EXPECT_EQ(map.nearest(center_of(0), {1, 0.1, Gate::kSurfaces}, &found, context), 0U);
  EXPECT_EQ(map.nearest(center_of(5), {1, 0.1, Gate::kSurfaces}, &found, context), 1U);
}

TEST(Lru, NeverExceedsCapacityOrMemoryWhateverIsInserted) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.capacity = 500;
  VoxelMap map(options);
  std::size_t after_warm_up = 0;
  for (int scan = 0; scan < 200; ++scan) {
    const double spread = scan % 3 == 0 ? 1e4 : 5.0;  // scattered and dense in turn
    const test::Cloud cloud = test::uniform_cloud(2000, spread, {scan * 10.0, 0, 0}, rng);
    const InsertStats stats = map.insert(cloud.points, cloud.normals);
    ASSERT_EQ(stats.map_full, 0U);
    ASSERT_LE(map.voxel_count(), 500U);
    ASSERT_LE(map.memory_bytes(), map.memory_limit_bytes());
    ASSERT_EQ(map.size(), map.points().size());
    if (scan == 50) {
      after_warm_up = map.memory_bytes();
    }
  }
  EXPECT_LE(map.memory_bytes(), after_warm_up + after_warm_up / 10);
}

TEST(Lru, MemoryIsFlatOverAMillionEvictions) {
  std::mt19937_64 rng = test::rng();
  MapOptions options;
  options.capacity = 5000;
  VoxelMap map(options);
  std::size_t evicted = 0;
  std::size_t after_a_tenth = 0;
  for (int scan = 0; evicted < 1'000'000; ++scan) {  // a walk through cluttered rooms
    const test::Cloud cloud = test::uniform_cloud(3000, 3.0, {scan * 3.0, 0, 0}, rng);
    evicted += map.insert(cloud.points, cloud.normals).evicted_voxels;
    after_a_tenth = evicted < 100'000 ? map.memory_bytes() : after_a_tenth;
    ASSERT_LE(map.voxel_count(), 5000U);
  }
  EXPECT_LE(map.memory_bytes(), after_a_tenth + after_a_tenth / 20);  // the ring of epochs fills
}

TEST(Lru, MaxBytesBoundsTheMapAndKeepsItWorking) {
  std::mt19937_64 rng = test::rng();
  for (const std::size_t max_bytes : {std::size_t{1} << 20, std::size_t{3} << 20}) {
    MapOptions options;
    options.max_bytes = max_bytes;
    VoxelMap map(options);
    EXPECT_LE(map.memory_limit_bytes(), max_bytes + sizeof(VoxelMap));
    for (int scan = 0; scan < 30; ++scan) {
      const test::Cloud cloud =
          test::uniform_cloud(20000, scan % 2 == 0 ? 20.0 : 2000.0, {scan * 5.0, 0, 0}, rng);
      const InsertStats stats = map.insert(cloud.points, cloud.normals);
      ASSERT_EQ(stats.map_full, 0U);
      ASSERT_GT(stats.stored, 5000U);
      ASSERT_LE(map.memory_bytes(), map.memory_limit_bytes());
      ASSERT_EQ(map.size(), map.points().size());
    }
  }
}

/// A cube of 3 x 3 x 3 points, of which the first `count`, in voxel `number` of a row; they look
/// along `normal`.
void add_voxel(
    int number, int count, const Eigen::Vector3f& normal, Points& points, Normals& normals) {
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    points.push_back(center_of(number) + 0.05 * step);
    normals.push_back(normal);
  }
}

// All voxels are used in one insertion, and the first one has to grow when all memory is taken: it
// is the oldest, and the one that may not go.
TEST(Lru, TheVoxelThatGrowsIsNotEvictedForItself) {
  MapOptions options;
  options.max_bytes = MapOptions::kMinBytes;
  options.min_point_distance = 0.0;
  const Eigen::Vector3f front = Eigen::Vector3f::UnitX();
  const auto filled = [&](int voxels, Points& points, Normals& normals) {
    add_voxel(0, 8, front, points, normals);
    for (int voxel = 1; voxel < voxels; ++voxel) {
      add_voxel(voxel, 20, front, points, normals);
    }
  };
  int fitting = 1;
  for (int step = 4096; step > 0; step /= 2) {  // the most that fit without an eviction
    Points points;
    Normals normals;
    filled(fitting + step, points, normals);
    fitting += VoxelMap(options).insert(points, normals).evicted_voxels == 0 ? step : 0;
  }
  Points points;
  Normals normals;
  filled(fitting, points, normals);
  add_voxel(0, 20, front, points, normals);   // the front grows: 8 of them are there already
  add_voxel(0, 20, -front, points, normals);  // a back is made
  VoxelMap map(options);
  const InsertStats stats = map.insert(points, normals);
  EXPECT_GE(stats.evicted_voxels, 1U);
  EXPECT_EQ(stats.map_full, 0U);
  EXPECT_EQ(map.size(), stats.stored - stats.evicted_points);
  EXPECT_EQ(map.points().size(), map.size());
  std::size_t grown = 0;
  map.for_each_within(center_of(0), 0.15, [&](const Neighbor&) { ++grown; });
  EXPECT_EQ(grown, 40U);
  EXPECT_EQ(MapArchive::read(MapArchive::write(map)).size(), map.size());  // it still has its turn
}

TEST(RadiusEviction, KeepsWhatIsNear) {
  std::mt19937_64 rng = test::rng();
  VoxelMap map;
  std::size_t stored = 0;
  for (int scan = 0; scan < 40; ++scan) {
    Pose T = Pose::Identity();
    T.translation().x() = scan;
    const test::Cloud cloud = test::uniform_cloud(2000, 30.0, Eigen::Vector3d::Zero(), rng);
    InsertStats stats = map.insert(cloud.points, cloud.normals, T);
    const std::size_t voxels = map.voxel_count();
    ASSERT_EQ(stats.evicted_points, 0U);
    map.keep_within(T.translation(), 10.0, stats);
    stored += stats.stored;
    stored -= stats.evicted_points;
    ASSERT_EQ(map.size(), stored);
    ASSERT_EQ(voxels - map.voxel_count(), stats.evicted_voxels);
    ASSERT_GT(stats.evicted_voxels, 100U);
    map.for_each_point([&](const MapPoint& point) {
      ASSERT_LE((point.position - T.translation()).norm(), 10.0 + 0.27);  // half a voxel's diagonal
    });
  }
}

// A robot has driven 150 m; its host inserts points that are in the map frame already.
TEST(RadiusEviction, IsNoPartOfInsertion) {
  MapOptions options;
  options.eviction = Eviction::kRadius;
  options.eviction_radius = 100.0;
  VoxelMap map(options);
  const InsertStats stats =
      map.insert(Points{{150.1, 0.1, 0.1}}, Normals{Eigen::Vector3f::UnitZ()});
  EXPECT_EQ(stats.stored, 1U);
  EXPECT_EQ(stats.evicted_points, 0U);
  EXPECT_EQ(map.size(), 1U);
}

}  // namespace
}  // namespace nvm
