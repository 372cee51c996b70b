// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>
#include <pcl_conversions/pcl_conversions.h>

#include <algorithm>
#include <execution>
#include <memory>
#include <random>

#include "adapters/ct_lio/ct_lio_map.hpp"
#include "adapters/ros_hosts/fast_lio_node.hpp"
#include "support/rng.hpp"
#include "support/sanitizers.hpp"

// ct-lio has this at global scope.
struct voxel {
  short x, y, z;
};

// ivox.hpp takes the place of a header that Point-LIO includes in angle brackets.
#include <ivox/ivox3d.h>

namespace {

constexpr double kFace = 0.025;  // [m], of a 5 cm wall at x = 0

/// The pose of a node that looks at the wall from `x`, with a LiDAR that is not aligned to its IMU.
NodeState state_at(double x) {
  NodeState state;
  state.pos = Vector3d(x, 0.3, -0.1);
  state.rot = AngleAxisd(0.4 * x, Vector3d::UnitZ());
  state.offset_R_L_I = AngleAxisd(0.5, Vector3d(1, 2, 3).normalized());
  state.offset_T_L_I = Vector3d(0.05, -0.02, 0.1);
  return state;
}

/// A scan of the face of the wall that a LiDAR on the side of `x` sees, in the LiDAR's frame.
PointCloudXYZI scan_of_wall(double x, const NodeState& state, mt19937_64& rng) {
  uniform_real_distribution<double> u(-1.5, 1.5);
  normal_distribution<double> noise(0.0, 0.004);
  PointCloudXYZI scan;
  for (int i = 0; i < 12000; ++i) {
    const Vector3d p_world(copysign(kFace, x) + noise(rng), u(rng), u(rng));
    PointType point;
    point.getVector3fMap() = state.to_body(p_world).cast<float>();
    point.intensity = 7.0F;
    point.curvature = static_cast<float>(i) * 0.008F;  // the time [ms]
    scan.push_back(point);
  }
  return scan;
}

sensor_msgs::PointCloud2::ConstPtr message_of(const PointCloudXYZI& scan) {
  const auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  pcl::toROSMsg(scan, *message);
  return message;
}

struct Matches {
  size_t queries = 0, short_of_five = 0, wrong_side = 0;
};

/// Points near the wall's edges, where a plane has neighbours on one side only, are left out.
Matches count_matches(const PointCloudXYZI& scan_world, const vector<PointVector>& nearest) {
  Matches matches;
  for (size_t i = 0; i < scan_world.size(); ++i) {
    if (max(abs(scan_world[i].y), abs(scan_world[i].z)) > 1.2F) {
      continue;
    }
    ++matches.queries;
    matches.short_of_five += nearest[i].size() < 5 ? 1U : 0U;
    matches.wrong_side += any_of(nearest[i].begin(), nearest[i].end(), [&](const PointType& p) {
      return (p.x > 0.0F) != (scan_world[i].x > 0.0F);
    });
  }
  return matches;
}

/// Both sides of the wall, one after the other, and the first once more.
Matches walk_around_the_wall(FastLioNode& node) {
  mt19937_64 rng = nvm::test::rng();
  for (const double x : {-3.0, -2.8, 3.0, 2.8, -3.0}) {
    const NodeState state = state_at(x);
    node.process(message_of(scan_of_wall(x, state, rng)), state);
  }
  return count_matches(node.scan_world(), node.nearest_points());
}

TEST(RosHosts, FastLioRunsWithPatchAAndMatchesBothSides) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("libgomp");
  FastLioNode node(Patch::kA);
  const Matches matches = walk_around_the_wall(node);
  EXPECT_GT(matches.queries, 100U);
  EXPECT_EQ(matches.short_of_five, 0U);
  EXPECT_GT(matches.wrong_side, matches.queries / 4);
}

TEST(RosHosts, FastLioTellsSidesApartWithAViewPoint) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("libgomp");
  FastLioNode node(Patch::kViewDirection);
  const Matches matches = walk_around_the_wall(node);
  EXPECT_EQ(matches.short_of_five, 0U);
  EXPECT_EQ(matches.wrong_side, 0U);
}

TEST(RosHosts, FastLioKeepsTwoSidesWithPatchB) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("libgomp");
  FastLioNode node(Patch::kB);
  const Matches matches = walk_around_the_wall(node);
  EXPECT_EQ(matches.short_of_five, 0U);
  EXPECT_EQ(matches.wrong_side, 0U);
  PointCloudXYZI map;
  pcl::fromROSMsg(node.map_message(), map);
  EXPECT_GT(map.size(), 300U);
  for (const PointType& point : map) {
    EXPECT_EQ(point.normal_x > 0.0F, point.x > 0.0F);
    EXPECT_EQ(point.curvature, 0.0F);  // no times in the map
  }
}

// Point-LIO and faster-lio, whose map type the node's points go into as they are.
TEST(RosHosts, IVoxHostsSearchInParallel) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("the standard library's parallel algorithms");
  using IVoxType = faster_lio::IVox<3, faster_lio::IVoxNodeType::DEFAULT, PointType>;
  FastLioNode node(Patch::kB);
  walk_around_the_wall(node);
  PointCloudXYZI map;
  pcl::fromROSMsg(node.map_message(), map);
  IVoxType::Options options;
  options.resolution_ = 0.3F;
  options.nearby_type_ = IVoxType::NearbyType::NEARBY18;
  options.nvm.map.min_point_distance = 0.0;  // all that the node's map has kept
  const auto ivox = make_shared<IVoxType>(options);
  ivox->AddPoints(map.points);
  EXPECT_EQ(ivox->NumPoints(), map.size());
  const PointCloudXYZI& scan = node.scan_world();
  vector<PointVector> nearest(scan.size());
  for_each(execution::par_unseq, scan.begin(), scan.end(), [&](const PointType& point) {
    ivox->GetClosestPoint(point, nearest[static_cast<size_t>(&point - scan.data())], 5);
  });
  const Matches matches = count_matches(scan, nearest);
  EXPECT_EQ(matches.short_of_five, 0U);
  EXPECT_EQ(matches.wrong_side, 0U);
}

// ct-lio's own vectors, beside its names.
TEST(RosHosts, CtLioGetsTheTypeThatItExpects) {
  mt19937_64 rng = nvm::test::rng();
  nvm::adapters::CtLioMap voxel_map;
  vector<Vector3d> points, normals;
  for (const double x : {-2.0, 2.0}) {
    const NodeState state = state_at(x);
    for (const PointType& point : scan_of_wall(x, state, rng)) {
      points.push_back(state.to_world(point.getVector3fMap().cast<double>()));
      normals.push_back(Vector3d::UnitX() * copysign(1.0, x));
    }
  }
  voxel_map.add(points, normals);
  const vector<Vector3d, Eigen::aligned_allocator<Vector3d>> neighbors =
      voxel_map.search(Vector3d(0.0, 0.1, 0.2), Vector3d::UnitX(), 20, 2);
  EXPECT_EQ(neighbors.size(), 20U);
  for (const Vector3d& neighbor : neighbors) {
    EXPECT_GT(neighbor.x(), 0.0);
  }
  EXPECT_EQ(sizeof(voxel), 6U);
}

}  // namespace
