// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/common/host_map.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <functional>
#include <thread>
#include <vector>

#include "adapters/ct_lio/ct_lio_map.hpp"
#include "adapters/host_point.hpp"
#include "adapters/ikd_tree/ikd_tree.hpp"
#include "adapters/kiss_icp/kiss_map.hpp"
#include "adapters/small_gicp/map_traits.hpp"
#include "nvm/geometry/pose.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using adapters::HostMap;
using adapters::HostOptions;
using adapters::MissingNormal;
using adapters::NormalSource;

// Constructed before main, as hosts' global variables are.
adapters::CtLioMap global_map;

/// A wall's two faces, each with two points: one whose normal looks at a sensor in front of its
/// face, and one without a normal.
struct Scene {
  Eigen::Vector3d front_sensor{0.1, 2.0, 0.1};
  Eigen::Vector3d back_sensor{0.1, -2.0, 0.1};
  test::HostPoints front = face(0.18, 1.0F);
  test::HostPoints back = face(0.12, -1.0F);

  static test::HostPoints face(double y, float side) {
    return {
        test::host_point({0.1, y, 0.1}, {0.0F, side, 0.0F}),
        test::host_point({0.2, y, 0.1}, Eigen::Vector3f::Zero())};
  }
};

/// How many points a policy stores of the scene, and how many of them a query finds that stands on
/// the front face, with a normal and without.
struct Found {
  std::size_t stored, with_normal, without;
};
bool operator==(const Found& a, const Found& b) {
  return a.stored == b.stored && a.with_normal == b.with_normal && a.without == b.without;
}
void PrintTo(const Found& found, std::ostream* out) {
  *out << found.stored << " stored, " << found.with_normal << " found with a normal, "
       << found.without << " without";
}

Found run(const adapters::NormalPolicy& policy, bool knows_sensor) {
  HostOptions options;
  options.normals = policy;
  options.map.min_point_distance = 0.0;
  HostMap map(options);
  const Scene scene;
  if (knows_sensor) {
    map.set_view_point(scene.back_sensor);
  }
  map.insert(scene.back);
  if (knows_sensor) {
    map.set_view_point(scene.front_sensor);
  }
  map.insert(scene.front);
  std::array<Neighbor, 8> found;
  const NearestSearch search{8, 1.0, Gate::kSurfaces};
  return {
      map.size(),
      map.nearest(scene.front[0], search, found.data()),
      map.nearest(scene.front[1], search, found.data())};
}

TEST(HostMap, FollowsTheSourceOfNormalsAndThePolicyForMissingOnes) {
  constexpr auto kPoint = NormalSource::kPoint;
  constexpr auto kView = NormalSource::kViewDirection;
  constexpr auto kNone = NormalSource::kNone;
  // Without a sensor.
  EXPECT_EQ(run({kPoint, kPoint, MissingNormal::kDrop}, false), (Found{2, 1, 0}));
  EXPECT_EQ(run({kPoint, kPoint, MissingNormal::kUngated}, false), (Found{4, 1, 4}));
  EXPECT_EQ(run({kPoint, kPoint, MissingNormal::kViewDirection}, false), (Found{4, 1, 4}));
  EXPECT_EQ(run({kView, kView, MissingNormal::kDrop}, false), (Found{0, 0, 0}));
  EXPECT_EQ(run({kView, kView, MissingNormal::kUngated}, false), (Found{4, 4, 4}));
  EXPECT_EQ(run({kNone, kNone, MissingNormal::kDrop}, false), (Found{4, 4, 4}));
  // With one.
  EXPECT_EQ(run({kPoint, kPoint, MissingNormal::kDrop}, true), (Found{2, 1, 0}));
  EXPECT_EQ(run({kPoint, kPoint, MissingNormal::kUngated}, true), (Found{4, 1, 4}));
  EXPECT_EQ(run({kPoint, kPoint, MissingNormal::kViewDirection}, true), (Found{4, 2, 2}));
  EXPECT_EQ(run({kView, kView, MissingNormal::kDrop}, true), (Found{4, 2, 2}));
  EXPECT_EQ(run({kNone, kNone, MissingNormal::kDrop}, true), (Found{4, 4, 4}));
  // Stored with sides, asked without.
  EXPECT_EQ(run({kView, kNone, MissingNormal::kDrop}, true), (Found{4, 4, 4}));
}

/// A face of a wall in y = `y`, 1 m square, with normals or what stands for them.
test::HostPoints patch(double y, const Eigen::Vector3f& normal) {
  test::HostPoints points;
  for (double x = 0.0; x < 1.0; x += 0.1) {
    for (double z = 0.0; z < 1.0; z += 0.1) {
      points.push_back(test::host_point({x, y, z}, normal));
    }
  }
  return points;
}

HostMap thin_wall_map(MissingNormal missing) {
  HostOptions options;
  options.normals.missing = missing;
  options.map.min_point_distance = 0.0;
  HostMap map(options);
  map.insert(patch(0.05, Eigen::Vector3f::UnitY()));
  map.insert(patch(0.0, -Eigen::Vector3f::UnitY()));
  return map;
}

TEST(HostMap, AnswersSightingsBySurfacesOfTheSideThatTheySee) {
  const HostMap map = thin_wall_map(MissingNormal::kViewDirection);
  std::array<Neighbor, 5> found;
  const NearestSearch search{5, 1.0, Gate::kSurfaces};
  const auto ask = [&](const Eigen::Vector3f& sighting) {
    return map.nearest(test::host_point({0.52, 0.02, 0.52}, sighting), search, found.data());
  };
  const Eigen::Vector3f slanted = 0.5F * Eigen::Vector3f(0.6F, 0.8F, 0.0F);
  ASSERT_EQ(ask(slanted), 5U);
  EXPECT_NEAR(found[0].position.y(), 0.05, 1e-3);
  ASSERT_EQ(ask(-slanted), 5U);
  EXPECT_NEAR(found[0].position.y(), 0.0, 1e-3);
  EXPECT_EQ(ask(0.5F * Eigen::Vector3f::UnitX()), 0U) << "along the wall: either side";
}

TEST(HostMap, GivesSightingsNothingThatIsNoSurface) {
  HostMap map;
  const Eigen::Vector3f sighting = 0.5F * Eigen::Vector3f::UnitY();
  test::HostPoints ring;
  for (int i = 0; i < 20; ++i) {
    ring.push_back(test::host_point({0.12 * i, 0.05, 0.5}, sighting));
  }
  map.insert(ring);
  std::array<Neighbor, 5> found;
  const NearestSearch search{5, 1.0, Gate::kSurfaces};
  EXPECT_EQ(map.size(), ring.size());
  EXPECT_EQ(map.nearest(ring[8], search, found.data()), 0U) << "a line";
  const test::HostPoint normal = test::host_point({0.96, 0.05, 0.5}, Eigen::Vector3f::UnitY());
  EXPECT_EQ(map.nearest(normal, search, found.data()), 0U) << "only sightings find sightings";
}

TEST(HostMap, StoresSightingsWithTheNormalsOfSurfacesThatItKnows) {
  HostMap map = thin_wall_map(MissingNormal::kViewDirection);
  const Eigen::Vector3d position(0.54, 0.05, 0.54);
  map.insert(
      test::HostPoints{test::host_point(position, 0.5F * Eigen::Vector3f(0.6F, 0.8F, 0.0F))});
  std::size_t seen = 0;
  map.for_each_point([&](const Eigen::Vector3d& stored, const Eigen::Vector3f& normal) {
    if ((stored - position).norm() < 1e-3) {
      ++seen;
      EXPECT_GT(normal.y(), 0.99F);
    }
  });
  EXPECT_EQ(seen, 1U);
}

TEST(HostMap, TreatsSightingsAsMissingNormalsWhereThePolicySaysSo) {
  const test::HostPoint sighting =
      test::host_point({0.52, 0.02, 0.52}, 0.5F * Eigen::Vector3f::UnitY());
  std::array<Neighbor, 40> found;
  const NearestSearch search{40, 0.3, Gate::kSurfaces};
  HostMap dropping = thin_wall_map(MissingNormal::kDrop);
  EXPECT_EQ(dropping.nearest(sighting, search, found.data()), 0U);
  EXPECT_EQ(dropping.insert(test::HostPoints{sighting}).no_normal, 1U);
  HostMap ungated = thin_wall_map(MissingNormal::kUngated);
  const std::size_t count = ungated.nearest(sighting, search, found.data());
  const auto is_back = [](const Neighbor& n) { return n.position.y() < 0.02; };
  EXPECT_TRUE(std::any_of(found.begin(), found.begin() + count, is_back)) << "both sides";
  EXPECT_EQ(ungated.insert(test::HostPoints{sighting}).stored, 1U);
}

TEST(HostMap, EvictsByTheDistanceToTheSensor) {
  HostOptions options;
  options.map.eviction = Eviction::kRadius;
  options.map.eviction_radius = 5.0;
  HostMap map(options);
  const test::HostPoints points{test::host_point({0, 0, 0}), test::host_point({9, 0, 0})};
  map.insert(points);  // no sensor yet: all stay
  EXPECT_EQ(map.size(), 2U);
  map.set_view_point({9, 1, 0});
  EXPECT_EQ(map.insert(test::HostPoints{}).evicted_points, 1U);
  EXPECT_EQ(map.voxel_count(), 1U);
  map.clear();
  EXPECT_EQ(map.size(), 0U);
}

TEST(HostMap, TakesNewOptionsAtAnyTime) {
  HostMap map;
  EXPECT_EQ(map.map(), nullptr);
  EXPECT_EQ(map.size(), 0U);
  map.insert(Scene().front);
  EXPECT_GT(map.size(), 0U);
  HostOptions options;
  options.map.voxel_size = 0.7;
  map.configure(options);
  EXPECT_EQ(map.size(), 0U);
  map.insert(Scene().front);
  EXPECT_DOUBLE_EQ(map.map()->options().voxel_size, 0.7);
  options.map.voxel_size = 0.0;
  EXPECT_THROW(map.configure(options), std::invalid_argument);
  EXPECT_DOUBLE_EQ(map.options().map.voxel_size, 0.7) << "bad options change nothing";
  EXPECT_EQ(global_map.size(), 0U);
}

using Answers = std::vector<double>;

/// The same queries from one thread and from four at once; run under ThreadSanitizer.
void expect_same_from_many_threads(const std::function<void(std::size_t, Answers&)>& ask) {
  const auto ask_all = [&](Answers& answers) {
    for (std::size_t i = 0; i < 1000; ++i) {
      ask(i, answers);
    }
  };
  Answers alone;
  ask_all(alone);
  EXPECT_FALSE(alone.empty());
  std::array<Answers, 4> together;
  std::vector<std::thread> threads;
  for (Answers& answers : together) {
    threads.emplace_back([&] { ask_all(answers); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_THAT(together, testing::Each(alone));
}

TEST(Adapters, QueriesFromManyThreadsAgreeWithOneThread) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::thin_wall(3000, 0.05, rng);
  const test::HostPoints points = test::host_points_with_normals(cloud);

  adapters::IkdTree<test::HostPoint> tree;
  tree.options().reach = 1.0;
  tree.Build(points);
  expect_same_from_many_threads([&](std::size_t i, Answers& answers) {
    test::HostPoints near;
    std::vector<float> sq_distances;
    tree.Nearest_Search(points[i], 5, near, sq_distances);
    answers.insert(answers.end(), sq_distances.begin(), sq_distances.end());
  });

  adapters::KissMap<Pose> kiss(0.5, 100.0, 20);
  kiss.Update(cloud.points, Eigen::Vector3d(0, 4, 0));
  expect_same_from_many_threads([&](std::size_t i, Answers& answers) {
    answers.push_back(std::get<1>(kiss.GetClosestNeighbor(cloud.points[i])));
  });

  adapters::CtLioMap ct_lio;
  ct_lio.add(cloud.points, cloud.normals);
  expect_same_from_many_threads([&](std::size_t i, Answers& answers) {
    const Eigen::Vector3d normal = cloud.normals[i].cast<double>();
    for (const auto& point : ct_lio.search(cloud.points[i], normal, 20, 1 + (i % 50 == 0))) {
      answers.push_back(point.x());
    }
  });

  VoxelMap map;
  map.insert(cloud.points, cloud.normals);
  expect_same_from_many_threads([&](std::size_t i, Answers& answers) {
    std::size_t id = 0;
    double sq_distance = 0.0;
    small_gicp::traits::Traits<VoxelMap>::nearest_neighbor_search(
        map, cloud.points[i].homogeneous(), &id, &sq_distance);
    answers.push_back(sq_distance);
  });
}

}  // namespace
}  // namespace nvm
