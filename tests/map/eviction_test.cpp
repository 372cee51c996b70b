// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <vector>

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

TEST(Erase, LeavesExactlyWhatIsOutside) {
  std::mt19937_64 rng = test::rng();
  for (int round = 0; round < 20; ++round) {
    VoxelMap map;
    const test::Cloud cloud = test::uniform_cloud(5000, 5.0, {1.0, -2.0, 3.0}, rng);
    map.insert(cloud.points, cloud.normals);
    const Eigen::Vector3d a = cloud.points[0];
    const Eigen::Vector3d b = cloud.points[1];
    const Eigen::Vector3d min = a.cwiseMin(b);
    const Eigen::Vector3d max = a.cwiseMax(b);
    const auto inside = [&](const MapPoint& point) {
      return round % 2 == 0 ? ((point.position - min).minCoeff() >= 0.0 &&
                               (max - point.position).minCoeff() >= 0.0)
                            : (point.position - a).norm() <= 1.3;
    };
    std::set<std::array<double, 3>> expected;
    std::size_t erased = 0;
    for (const MapPoint& point : map.points()) {
      if (inside(point)) {
        ++erased;
      } else {
        expected.insert({point.position.x(), point.position.y(), point.position.z()});
      }
    }
    EXPECT_EQ(round % 2 == 0 ? map.erase_box(min, max) : map.erase_within(a, 1.3), erased);
    ASSERT_EQ(map.size(), expected.size());
    for (const MapPoint& point : map.points()) {
      ASSERT_EQ(expected.count({point.position.x(), point.position.y(), point.position.z()}), 1U);
    }
    // The map goes on working.
    map.insert(cloud.points, cloud.normals);
    VoxelMap::QueryContext context;
    Neighbor found;
    EXPECT_EQ(map.nearest(a, {1, 0.2, Gate::kSurfaces}, &found, context), 1U);
  }
}

TEST(Erase, EverythingInAnyWay) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(5000, 5.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap map;
  for (int way = 0; way < 4; ++way) {
    const InsertStats stats = map.insert(cloud.points, cloud.normals);
    ASSERT_EQ(map.size(), stats.stored);
    switch (way) {
      case 0:
        map.erase_box(Eigen::Vector3d::Constant(-1e6), Eigen::Vector3d::Constant(1e6));
        break;
      case 1:
        map.erase_within(Eigen::Vector3d::Zero(), 100.0);
        break;
      case 2:
        map.erase_voxels_beyond({1e4, 0, 0}, 10.0);
        break;
      default:
        map.clear();
        break;
    }
    EXPECT_TRUE(map.empty());
    EXPECT_EQ(map.voxel_count(), 0U);
    EXPECT_TRUE(map.points().empty());
  }
  map.insert(cloud.points, cloud.normals);
  const double nan = std::nan("");
  EXPECT_EQ(map.erase_box({nan, 0, 0}, {1, 1, 1}), 0U);
  EXPECT_EQ(map.erase_within({0, 0, 0}, nan), 0U);
  EXPECT_EQ(map.erase_within({0, 0, 0}, -1.0), 0U);
  EXPECT_EQ(map.erase_voxels_beyond({nan, 0, 0}, 1.0), 0U);
  EXPECT_EQ(map.erase_voxels_beyond({0, 0, 0}, nan), 0U);
  EXPECT_EQ(map.erase_voxels_beyond({0, 0, 0}, -1.0), 0U);
}

TEST(RadiusQuery, FindsWhatBruteForceFinds) {
  std::mt19937_64 rng = test::rng();
  VoxelMap map;
  const test::Cloud cloud = test::uniform_cloud(8000, 12.0, {3.0, 0.0, -8.0}, rng);
  map.insert(cloud.points, cloud.normals);
  const std::vector<MapPoint> points = map.points();
  for (const double radius : {0.0, 0.2, 1.0, 4.0, 100.0}) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d center = cloud.points[rng() % cloud.points.size()];
      const auto expected = std::count_if(points.begin(), points.end(), [&](const MapPoint& point) {
        return (point.position - center).norm() <= radius;
      });
      std::set<PointId> found;
      map.for_each_within(center, radius, [&](const Neighbor& neighbor) {
        EXPECT_EQ(map.position(neighbor.id), neighbor.position);
        found.insert(neighbor.id);
      });
      EXPECT_EQ(found.size(), static_cast<std::size_t>(expected));
    }
  }
  const auto none = [](const Neighbor&) { FAIL(); };
  map.for_each_within({std::nan(""), 0, 0}, 1.0, none);
  map.for_each_within({0, 0, 0}, -1.0, none);
}

// Brick indices that far away do not fit into 32 bits: converting them gave an endless loop.
TEST(Erase, FarAwayFindsNothing) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(2000, 12.0, Eigen::Vector3d::Zero(), rng);
  VoxelMap map;
  map.insert(cloud.points, cloud.normals);
  const std::size_t size = map.size();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double far : {3.2e5, 2147483647 * 1.2 + 0.6, 2147483648 * 1.2, 1e10, 1e300}) {
    for (const double x : {far, -far}) {
      EXPECT_EQ(map.erase_within({x, 0, 0}, 0.1), 0U) << x;
      EXPECT_EQ(map.erase_within({0, x, x}, 0.1), 0U) << x;
      EXPECT_EQ(map.erase_box({x, 0, 0}, {x, 0.1, 0.1}), 0U) << x;
      map.for_each_within({0, 0, x}, 0.1, [](const Neighbor&) { FAIL(); });
    }
  }
  EXPECT_EQ(map.erase_box({1, 1, 1}, {-1, -1, -1}), 0U);
  EXPECT_EQ(map.erase_box({-inf, -inf, inf}, {inf, inf, inf}), 0U);
  EXPECT_EQ(map.size(), size);
  std::size_t found = 0;
  map.for_each_within({0, 0, 0}, inf, [&](const Neighbor&) { ++found; });
  map.for_each_within({1e10, 0, 0}, 1.1e10, [&](const Neighbor&) { ++found; });
  EXPECT_EQ(found, 2 * size);
  EXPECT_EQ(map.erase_box({-inf, -inf, -inf}, {inf, inf, inf}), size);
}

}  // namespace
}  // namespace nvm
