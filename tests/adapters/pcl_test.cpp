// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <cmath>

#include "adapters/common/scan_normals.hpp"
#include "adapters/ikd_tree/ikd_tree.hpp"
#include "adapters/pcl/cloud.hpp"
#include "adapters/pcl/map_search.hpp"
#include "adapters/pcl/normal_estimation.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"
#include "support/sanitizers.hpp"

namespace nvm {
namespace {

using Cloud = ::pcl::PointCloud<::pcl::PointXYZ>;
using Normals = ::pcl::PointCloud<::pcl::Normal>;

Cloud::Ptr wall_cloud(std::mt19937_64& rng) {
  const auto cloud = ::pcl::make_shared<Cloud>();
  for (const Eigen::Vector3d& p : test::thin_wall(6000, 1.0, rng).points) {
    cloud->push_back(adapters::make_point<::pcl::PointXYZ>(p));
  }
  return cloud;
}

/// The calls that users of pcl::NormalEstimationOMP make.
template <class Estimator>
Normals estimate(const Cloud::ConstPtr& cloud, const ::pcl::IndicesConstPtr& indices = {}) {
  Estimator estimator;
  estimator.setNumberOfThreads(2);
  estimator.setInputCloud(cloud);
  if (indices) {
    estimator.setIndices(indices);
  }
  const auto tree = ::pcl::make_shared<::pcl::search::KdTree<::pcl::PointXYZ>>();
  estimator.setSearchMethod(tree);
  estimator.setViewPoint(0.0F, 5.0F, 0.0F);
  estimator.setRadiusSearch(0.3);
  Normals normals;
  estimator.compute(normals);
  return normals;
}

TEST(PclNormals, AreThoseOfPcl) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("libgomp");
  std::mt19937_64 rng = test::rng();
  const Cloud::Ptr cloud = wall_cloud(rng);
  const Normals theirs =
      estimate<::pcl::NormalEstimationOMP<::pcl::PointXYZ, ::pcl::Normal>>(cloud);
  const Normals ours = estimate<adapters::NormalEstimation<::pcl::PointXYZ, ::pcl::Normal>>(cloud);
  ASSERT_EQ(ours.size(), theirs.size());
  EXPECT_EQ(ours.width, theirs.width);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    EXPECT_GT(adapters::normal_field(ours[i]).dot(adapters::normal_field(theirs[i])), 0.9995F);
  }
  const auto indices = ::pcl::make_shared<::pcl::Indices>(::pcl::Indices{5, 17, 4});
  const Normals some =
      estimate<adapters::NormalEstimation<::pcl::PointXYZ, ::pcl::Normal>>(cloud, indices);
  ASSERT_EQ(some.size(), 3U);
  EXPECT_GT(adapters::normal_field(some[1]).dot(adapters::normal_field(theirs[17])), 0.9995F);
}

TEST(PclNormals, RefuseWhatTheyCannotDo) {
  std::mt19937_64 rng = test::rng();
  adapters::NormalEstimation<::pcl::PointXYZ, ::pcl::Normal> estimator;
  Normals normals;
  estimator.compute(normals);  // no input
  EXPECT_TRUE(normals.empty());
  estimator.setInputCloud(wall_cloud(rng));
  estimator.setKSearch(10);
  estimator.compute(normals);
  EXPECT_TRUE(normals.empty());
  estimator.setKSearch(0);
  estimator.options().min_neighbors = 0;
  estimator.compute(normals);
  EXPECT_TRUE(normals.empty());
}

TEST(PclCloud, GoesInAndOutWithItsNormals) {
  std::mt19937_64 rng = test::rng();
  ::pcl::PointCloud<::pcl::PointNormal> scan;
  const Cloud::Ptr cloud = wall_cloud(rng);
  NormalOptions options;
  options.min_radius = options.max_radius = 0.3;
  const Normals normals = adapters::normals_of(*cloud, Eigen::Vector3d(0, 5, 0), options);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    scan.push_back(adapters::make_point<::pcl::PointNormal>(
        position((*cloud)[i]), adapters::normal_field(normals[i])));
  }
  VoxelMap map;
  const InsertStats stats = adapters::insert(map, scan);
  EXPECT_GT(stats.stored, 1000U);
  const auto exported = adapters::to_cloud<::pcl::PointNormal>(map);
  ASSERT_EQ(exported.size(), map.size());
  EXPECT_EQ(exported.width, map.size());
  for (const auto& point : exported) {
    EXPECT_NEAR(adapters::normal_field(point).norm(), 1.0F, 1e-5F);
    EXPECT_GT(point.normal_y, 0.5F);
  }
}

TEST(PclSearch, FindsWhatPclFinds) {
  std::mt19937_64 rng = test::rng();
  MapOptions map_options;
  map_options.min_point_distance = 0.0;
  VoxelMap map(map_options);
  const test::Cloud cloud = test::uniform_cloud(3000, 6.0, {0, 0, 0}, rng);
  map.insert(cloud.points, cloud.normals);
  adapters::MapSearch<::pcl::PointNormal> ours(map);
  ::pcl::search::KdTree<::pcl::PointNormal> theirs;
  theirs.setInputCloud(ours.getInputCloud());
  EXPECT_EQ(ours.getInputCloud()->size(), map.size());
  ::pcl::Indices our_indices, their_indices;
  std::vector<float> our_distances, their_distances;
  const auto expect_same = [&](const Eigen::Vector3d& query) {
    ASSERT_EQ(our_indices.size(), their_indices.size());
    for (std::size_t i = 0; i < our_indices.size(); ++i) {
      const auto& point = (*ours.getInputCloud())[static_cast<std::size_t>(our_indices[i])];
      EXPECT_NEAR(std::sqrt(our_distances[i]), std::sqrt(their_distances[i]), 1e-4);
      EXPECT_NEAR(std::sqrt(our_distances[i]), (position(point) - query).norm(), 1e-4);
    }
  };
  for (const Eigen::Vector3d& p : test::uniform_cloud(100, 9.0, {0, 0, 0}, rng).points) {
    const auto query = adapters::make_point<::pcl::PointNormal>(p);
    for (const int k : {1, 5, 64, 200}) {
      ours.nearestKSearch(query, k, our_indices, our_distances);
      theirs.nearestKSearch(query, k, their_indices, their_distances);
      expect_same(p);
    }
    EXPECT_EQ(
        ours.radiusSearch(query, 0.7, our_indices, our_distances),
        theirs.radiusSearch(query, 0.7, their_indices, their_distances));
    expect_same(p);
    EXPECT_LE(ours.radiusSearch(query, 0.7, our_indices, our_distances, 3), 3);
  }
  EXPECT_EQ(ours.nearestKSearch(7, 1, our_indices, our_distances), 1);
  EXPECT_EQ(our_indices[0], 7);
  EXPECT_THROW(
      ours.setInputCloud(::pcl::make_shared<::pcl::PointCloud<::pcl::PointNormal>>()),
      std::invalid_argument);
}

// FAST_LIO's patch B on its own point type and clouds: estimate on the thinned scan, rotate where
// points are transformed, let the normals ride in the points.
TEST(PclHosts, CarryNormalsThroughTheirOwnPoints) {
  using Point = ::pcl::PointXYZINormal;
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(6000, 0.05, rng);
  ::pcl::PointCloud<Point> undistorted, down, world;
  for (std::size_t i = 0; i < wall.points.size(); i += 2) {  // the face that the sensor sees
    Point point = adapters::make_point<Point>(wall.points[i] - Eigen::Vector3d(0, 3, 0));
    point.curvature = 42.0F;
    undistorted.push_back(point);
    if (i % 4 == 0) {
      down.push_back(point);
    }
  }
  NormalOptions options;
  options.min_radius = options.max_radius = 0.3;
  adapters::ScanNormals scan_normals(options);
  const NormalStats stats = scan_normals.write(down.points, undistorted.points);
  EXPECT_GT(stats.valid, down.size() * 9 / 10);
  const Eigen::Matrix3d half_turn = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  world = down;
  for (std::size_t i = 0; i < down.size(); ++i) {
    world[i] = adapters::make_point<Point>(half_turn * position(down[i]));
    adapters::rotate_normal(half_turn, down[i], world[i]);
    EXPECT_EQ(down[i].curvature, 42.0F);
    if (adapters::is_unit_normal(adapters::normal_field(world[i]))) {
      EXPECT_LT(world[i].normal_y, -0.8F);  // still at the sensor, which is on that side now
    }
  }
  adapters::IkdTree<Point> tree;
  tree.Build(world.points);
  EXPECT_GT(tree.map().map()->size(), 100U);
}

}  // namespace
}  // namespace nvm
