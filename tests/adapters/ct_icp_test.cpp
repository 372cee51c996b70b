// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "adapters/ct_icp/slam_map.hpp"
#include "adapters/ct_icp/strategy.hpp"
#include "adapters/reference_search.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

using adapters::NvmSlamMap;
using adapters::NvmSlamMapOptions;

/// Made as CT-ICP makes it: from options, behind its interface.
std::shared_ptr<ct_icp::ISlamMap> make_map(const NvmSlamMapOptions& options) {
  const ct_icp::IMapOptions& host_view = options;
  EXPECT_EQ(host_view.GetType(), "NVM");
  return host_view.MakeMapFromOptions();
}

slam::PointCloud cloud_of(const std::vector<Eigen::Vector3d>& points) {
  slam::PointCloud cloud;
  cloud.raw = points;
  return cloud;
}

slam::Pose pose_at(const Eigen::Vector3d& position) {
  slam::Pose pose;
  pose.pose.tr = position;
  return pose;
}

TEST(CtIcpMap, TransparentFindsAllWithinTheRadius) {
  std::mt19937_64 rng = test::rng();
  NvmSlamMapOptions options;
  options.host = adapters::transparent_options(0.5);
  options.host.reach = 2.0;
  const auto map = make_map(options);
  const test::Cloud cloud = test::uniform_cloud(3000, 4.0, {0, 0, 0}, rng);
  std::vector<std::size_t> selected;
  map->InsertPointCloud(cloud_of(cloud.points), {slam::Pose()}, selected);
  EXPECT_EQ(selected.size(), cloud.points.size());
  EXPECT_EQ(map->NumPoints(), cloud.points.size());
  for (const Eigen::Vector3d& query : test::uniform_cloud(100, 5.0, {0, 0, 0}, rng).points) {
    for (const double radius : {0.3, 0.8, 1.5}) {
      const auto expected =
          test::nearest_distances(cloud.points, query, 20, [&](const Eigen::Vector3d& p) {
            return (p - query).norm() <= radius;
          });
      const slam::Neighborhood found = map->RadiusSearch(query, radius, 20);
      ASSERT_NEAR(
          static_cast<double>(found.points.size()), static_cast<double>(expected.size()), 1.0);
      for (std::size_t i = 0; i < std::min(found.points.size(), expected.size()); ++i) {
        EXPECT_NEAR((found.points[i] - query).norm(), expected[i], 2 * test::kLattice);
      }
    }
  }
}

TEST(CtIcpMap, TheSensorLocationKeepsTheSidesOfAWallApart) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(6000, 0.05, rng);
  std::vector<Eigen::Vector3d> front, back;
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    (wall.normals[i].y() > 0.0F ? front : back).push_back(wall.points[i]);
  }
  const auto map = make_map(NvmSlamMapOptions{});
  std::vector<std::size_t> selected;
  Eigen::Vector3d sensor(0.0, 4.0, 0.0);
  map->InsertPointCloud(cloud_of(front), {pose_at(Eigen::Vector3d::Zero())}, selected);
  map->ClearMap();
  EXPECT_EQ(map->NumPoints(), 0U);
  slam::PointCloud world = cloud_of(front);
  world.world = front;  // already in the map frame
  map->InsertPointCloud(world, {pose_at(sensor), pose_at(sensor)}, selected);
  world.raw = world.world = back;
  map->InsertPointCloud(world, {pose_at(-sensor)}, selected);

  adapters::NvmStrategy::Options strategy_options;
  const auto strategy = strategy_options.MakeStrategyFromOptions();
  for (std::size_t i = 0; i < front.size(); i += 5) {
    slam::Neighborhood neighborhood;
    strategy->ComputeNeighborhoodInPlace(*map, {front[i]}, neighborhood, &sensor);
    EXPECT_FALSE(neighborhood.points.empty());
    for (const Eigen::Vector3d& point : neighborhood.points) {
      EXPECT_GT(point.y(), test::kWallY);
    }
    EXPECT_GT(map->RadiusSearch(front[i], 0.8).points.size(), neighborhood.points.size());
  }
  const slam::PointCloudPtr exported = map->MapAsPointCloud();
  EXPECT_EQ(exported->size(), map->NumPoints());
  map->RemoveElementsFarFromLocation({100, 0, 0}, 10.0);
  EXPECT_EQ(map->NumPoints(), 0U);
}

TEST(CtIcpMap, StoresByTheSourceOfNormalsThatIsAskedFor) {
  const std::vector<Eigen::Vector3d> lone{{1, 0, 0}, {9, 0, 0}};  // no planes
  const auto stored = [&](adapters::NormalSource source, adapters::MissingNormal missing) {
    NvmSlamMapOptions options;
    options.host.normals.insert = source;
    options.host.normals.missing = missing;
    const auto map = make_map(options);
    std::vector<std::size_t> selected;
    map->InsertPointCloud(cloud_of(lone), selected);
    return map->NumPoints();
  };
  using adapters::MissingNormal;
  using adapters::NormalSource;
  EXPECT_EQ(stored(NormalSource::kPoint, MissingNormal::kDrop), 0U);
  EXPECT_EQ(stored(NormalSource::kPoint, MissingNormal::kUngated), 2U);
  EXPECT_EQ(stored(NormalSource::kPoint, MissingNormal::kViewDirection), 2U);
  EXPECT_EQ(stored(NormalSource::kViewDirection, MissingNormal::kDrop), 2U);
  EXPECT_EQ(stored(NormalSource::kNone, MissingNormal::kDrop), 2U);
}

TEST(CtIcpMap, MovesRawPointsByThePosesOfTheirTimes) {
  const auto map = make_map(NvmSlamMapOptions{});
  slam::PointCloud cloud = cloud_of({{1, 0, 0}, {1, 0, 0}});
  cloud.timestamps = {10.0, 11.0};
  slam::Pose begin = pose_at({0, 0, 0}), end = pose_at({0, 4, 0});
  begin.dest_timestamp = 10.0;
  end.dest_timestamp = 12.0;
  std::vector<std::size_t> selected;
  map->InsertPointCloud(cloud, {begin, end}, selected);
  EXPECT_EQ(map->RadiusSearch({1, 0, 0}, 0.1).points.size(), 1U);
  EXPECT_EQ(map->RadiusSearch({1, 2, 0}, 0.1).points.size(), 1U);
  EXPECT_EQ(NvmSlamMap({}).density_warning(0.1), "");
  EXPECT_NE(NvmSlamMap({}).density_warning(0.3), "");
}

TEST(CtIcpMap, AnswersInTheOrderAndTheFormsThatTheHostAsksFor) {
  NvmSlamMapOptions options;
  options.host = adapters::transparent_options(0.5);
  options.farthest_first = true;
  const auto map = make_map(options);
  std::vector<std::size_t> selected;
  EXPECT_THROW(map->InsertPointCloud(cloud_of({}), {}, selected), std::invalid_argument);
  map->InsertPointCloud(cloud_of({{0.1, 0, 0}, {0.3, 0, 0}}), selected);
  slam::Neighborhood neighborhood{{{9, 9, 9}, {9, 9, 9}, {9, 9, 9}}};
  map->ComputeNeighborhoodInPlace({0, 0, 0}, 5, neighborhood);
  ASSERT_EQ(neighborhood.points.size(), 2U);
  EXPECT_GT(neighborhood.points[0].x(), neighborhood.points[1].x());
  EXPECT_EQ(map->ComputeNeighborhoods({{0, 0, 0}, {5, 5, 5}}, 1)[0].points.size(), 1U);
  EXPECT_THROW(
      map->ComputeNeighborhoods({{0, 0, 0}}, {1.0, 2.0}, 1, true, nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace nvm
