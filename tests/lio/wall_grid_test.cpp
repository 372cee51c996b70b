// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/place/wall_grid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace nvm::lio {
namespace {

/// The inside of an L-shaped room, a point each 20 cm.
std::vector<WallPoint> walls() {
  const std::vector<Eigen::Vector2d> corners = {{0, 0}, {9, 0}, {9, 4}, {4, 4}, {4, 7}, {0, 7}};
  std::vector<WallPoint> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
    const double facing = std::atan2(side.x(), -side.y());
    for (double s = 0.1; s < side.norm(); s += 0.2) {
      points.push_back({corners[i] + s * side.normalized(), facing});
    }
  }
  return points;
}

std::vector<WallPoint> seen_from(const Eigen::Vector2d& place, double heading, double turn) {
  std::vector<WallPoint> scan;
  const std::vector<WallPoint> all = walls();
  for (std::size_t i = 0; i < all.size(); i += 3) {
    scan.push_back(
        {Eigen::Rotation2Dd(-heading) * (all[i].position - place), all[i].facing - heading + turn});
  }
  return scan;
}

TEST(WallGrid, FindsThePlaceAndHeading) {
  const WallGrid grid(walls());
  for (const double heading : {0.0, 1.3, -2.8}) {
    const std::vector<WallPoint> scan = seen_from({2.0, 5.0}, heading, 0.0);
    const auto places = grid.search(scan, 3, scan.size() / 2);
    ASSERT_FALSE(places.empty());
    EXPECT_LT((places[0].position - Eigen::Vector2d(2.0, 5.0)).norm(), 0.7);
    EXPECT_LT(std::abs(std::remainder(places[0].heading - heading, 2.0 * M_PI)), 0.15);
    EXPECT_GE(places[0].hits, scan.size() * 9 / 10);
  }
}

TEST(WallGrid, SeesNothingOfWallsFromBehind) {
  const std::vector<WallPoint> scan = seen_from({2.0, 5.0}, 0.0, M_PI);
  EXPECT_TRUE(WallGrid(walls()).search(scan, 3, scan.size() * 3 / 4).empty());
}

TEST(WallGrid, RefusesAMapThatIsTooLarge) {
  std::vector<WallPoint> far = walls();
  far.push_back({{5e4, 5e4}, 0.0});
  const WallGrid grid(far);
  EXPECT_TRUE(grid.is_too_large());
  EXPECT_TRUE(grid.search(far, 3, 1).empty());
}

TEST(WallGrid, FindsNothingWithoutWalls) {
  EXPECT_TRUE(WallGrid({}).search(walls(), 3, 1).empty());
  EXPECT_TRUE(WallGrid(walls()).search({}, 3, 0).empty());
}

}  // namespace
}  // namespace nvm::lio
