// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/ikd_tree/ikd_tree.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <tuple>

#include "adapters/fast_lio_calls.hpp"
#include "adapters/reference_search.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"
#include "support/sanitizers.hpp"

namespace nvm {
namespace {

using Tree = adapters::IkdTree<test::HostPoint>;

Tree::PointVector search(const Tree& tree, const test::HostPoint& query, int k = 5) {
  Tree::PointVector points(3);  // what a previous query left
  std::vector<float> sq_distances(7);
  tree.Nearest_Search(query, k, points, sq_distances);
  EXPECT_EQ(points.size(), sq_distances.size());
  constexpr double kMoved = 0.02;  // onto the surface; distances are those of the stored points
  const double tolerance = tree.map().options().surface_neighbors > 0 ? kMoved : test::kLattice;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(
        (position(points[i]) - position(query)).norm(), std::sqrt(sq_distances[i]), tolerance);
  }
  EXPECT_TRUE(std::is_sorted(sq_distances.begin(), sq_distances.end()));
  return points;
}

/// What ikd-Tree keeps of points that are added with downsampling.
class CubeReference {
 public:
  explicit CubeReference(double cube) : cube_(cube) {}

  void add(const Eigen::Vector3d& point) {
    const Eigen::Vector3d index = (point / cube_).array().floor();
    const Eigen::Vector3d center = (index.array() + 0.5) * cube_;
    const auto [place, is_new] =
        kept_.try_emplace(std::make_tuple(index.x(), index.y(), index.z()), point);
    if (!is_new && (point - center).norm() < (place->second - center).norm()) {
      place->second = point;
    }
  }
  std::vector<Eigen::Vector3d> points() const {
    std::vector<Eigen::Vector3d> points;
    for (const auto& [index, point] : kept_) {
      points.push_back(point);
    }
    return points;
  }

 private:
  double cube_;
  std::map<std::tuple<double, double, double>, Eigen::Vector3d> kept_;
};

TEST(IkdTree, ServesTheCallsOfFastLio) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("libgomp");
  std::mt19937_64 rng = test::rng();
  const PointVector scan = test::host_points(test::uniform_cloud(2000, 3.0, {0, 0, 0}, rng).points);
  std::vector<BoxPointType> boxes;
  ikdtree.options().map.min_point_distance = 0.0;
  EXPECT_EQ(ikdtree.Root_Node, nullptr);
  map_one_scan(scan, boxes);
  EXPECT_NE(ikdtree.Root_Node, nullptr);
  EXPECT_EQ(ikdtree.size(), 2000);
  const std::vector<PointVector> nearest = map_one_scan(scan, boxes);
  ASSERT_EQ(nearest.size(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_EQ(nearest[i].size(), 5U);
    EXPECT_LT((position(nearest[i][0]) - position(scan[i])).norm(), test::kLattice);
  }
  EXPECT_EQ(ikdtree.PCL_Storage.size(), 2000U);
  boxes.push_back({{-10.0F, -10.0F, -10.0F}, {0.0F, 10.0F, 10.0F}});
  map_one_scan(scan, boxes);
  for (const PointType& point : ikdtree.PCL_Storage) {
    EXPECT_GE(point.x, 0.0F);
  }
}

TEST(IkdTree, TransparentKeepsAndFindsWhatIkdTreeDoes) {
  std::mt19937_64 rng = test::rng();
  Tree tree;
  tree.make_transparent();
  tree.set_downsample_param(0.5F);
  CubeReference reference(0.5);
  const test::Cloud first = test::uniform_cloud(100, 8.0, {0, 0, 0}, rng);
  for (const Eigen::Vector3d& point : first.points) {
    reference.add(point);
  }
  tree.Build(test::host_points(reference.points()));  // hosts build from a thinned scan
  for (int scan = 0; scan < 5; ++scan) {
    const test::Cloud cloud = test::uniform_cloud(1500, 8.0, {0.3 * scan, 0, 0}, rng);
    tree.Add_Points(test::host_points(cloud.points), true);
    for (const Eigen::Vector3d& point : cloud.points) {
      reference.add(point);
    }
  }
  const std::vector<Eigen::Vector3d> kept = reference.points();
  EXPECT_EQ(static_cast<std::size_t>(tree.size()), kept.size());
  for (const Eigen::Vector3d& query : test::uniform_cloud(300, 9.0, {0, 0, 0}, rng).points) {
    const std::vector<double> expected =
        test::nearest_distances(kept, query, 5, [&](const Eigen::Vector3d& p) {
          return (p - query).norm() <= std::sqrt(5.0);
        });
    const Tree::PointVector found = search(tree, test::host_point(query));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR((position(found[i]) - query).norm(), expected[i], test::kLattice);
    }
  }
}

/// How many of the neighbours of points on one face of a thin wall lie on the other.
std::size_t wrong_side(const Tree& tree, const test::Cloud& wall, const Tree::PointVector& points) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const test::HostPoint& found : search(tree, points[i])) {
      wrong += (found.y > test::kWallY) != (wall.normals[i].y() > 0.0F) ? 1U : 0U;
    }
  }
  return wrong;
}

TEST(IkdTree, NormalsInThePointsKeepTheSidesOfAWallApart) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(3000, 0.05, rng);
  for (const adapters::CubeRule rule :
       {adapters::CubeRule::kMap, adapters::CubeRule::kNearestToCenter}) {
    Tree tree;
    tree.cube_rule = rule;
    tree.set_downsample_param(0.2F);
    const Tree::PointVector points = test::host_points_with_normals(wall);
    tree.Build(points);
    tree.Add_Points(points, true);
    EXPECT_EQ(wrong_side(tree, wall, points), 0U);
    Tree bare;
    bare.Build(test::host_points(wall.points));
    EXPECT_GT(wrong_side(bare, wall, test::host_points(wall.points)), 1000U);
  }
}

TEST(IkdTree, TheCubeRuleKeepsOnePointPerSide) {
  Tree tree;
  tree.cube_rule = adapters::CubeRule::kNearestToCenter;
  tree.set_downsample_param(0.5F);
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  tree.Build({test::host_point({0.1, 0.1, 0.2}, up)});
  EXPECT_EQ(tree.Add_Points({test::host_point({0.2, 0.2, 0.2}, -up)}, true), 1);
  EXPECT_EQ(tree.size(), 2);
  EXPECT_EQ(tree.Add_Points({test::host_point({0.25, 0.25, 0.25}, up)}, true), 1);
  EXPECT_EQ(tree.Add_Points({test::host_point({0.05, 0.25, 0.25}, -up)}, true), 0);
  EXPECT_EQ(tree.size(), 2);
  EXPECT_EQ(tree.Add_Points({test::host_point({0.05, 0.25, 0.25}, -up)}, false), 0);
  EXPECT_EQ(tree.size(), 3);
}

TEST(IkdTree, AViewPointIsEnoughToKeepTheSidesApart) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(3000, 0.05, rng);
  Tree tree;
  Tree::PointVector front, back;
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    (wall.normals[i].y() > 0.0F ? front : back).push_back(test::host_point(wall.points[i]));
  }
  tree.set_view_point(0.0, 3.0, 0.0);
  tree.Build(front);
  tree.set_view_point(0.0, -3.0, 0.0);
  tree.Add_Points(back, true);
  for (const test::HostPoint& query : back) {
    for (const test::HostPoint& found : search(tree, query)) {
      EXPECT_LT(found.y, test::kWallY);
    }
  }
}

TEST(IkdTree, VoxelsFollowTheFilterSizeUnlessTheyAreGiven) {
  Tree tree;
  tree.set_downsample_param(0.5F);
  tree.Build({test::host_point({0, 0, 0})});
  EXPECT_DOUBLE_EQ(tree.map().options().map.voxel_size, 0.5);
  EXPECT_EQ(tree.density_warning(), "");
  tree.options().map.voxel_size = 0.3;
  EXPECT_THAT(tree.density_warning(), testing::HasSubstr("voxel_size = 0.3"));
  testing::internal::CaptureStderr();
  tree.Build({test::host_point({0, 0, 0})});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), tree.density_warning() + "\n");
  tree.options().map.voxel_size = -1.0;
  EXPECT_THROW(tree.Build({}), std::invalid_argument);
}

TEST(IkdTree, BadPointsAndEmptyTreesFindNothing) {
  Tree tree;
  EXPECT_TRUE(search(tree, test::host_point({0, 0, 0})).empty());
  EXPECT_EQ(tree.size(), 0);
  tree.Build({});
  EXPECT_EQ(tree.Root_Node, nullptr);
  const double nan = std::nan("");
  tree.Build({test::host_point({nan, 0, 0}), test::host_point({1, 0, 0})});
  tree.Add_Points({test::host_point({nan, 0, 0})}, true);
  EXPECT_EQ(tree.size(), 1);
  EXPECT_TRUE(search(tree, test::host_point({nan, 0, 0})).empty());
  EXPECT_TRUE(search(tree, test::host_point({1, 0, 0}), 0).empty());
}

}  // namespace
}  // namespace nvm
