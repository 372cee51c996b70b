// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/registration/association.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <vector>

#include "nvm/map/kd_tree_map.hpp"

namespace nvm {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

// A grid of 0.2 m on the plane z = 0.
std::vector<Eigen::Vector3d> floor_points() {
  std::vector<Eigen::Vector3d> points;
  for (int x = -5; x <= 5; ++x) {
    for (int y = -5; y <= 5; ++y) {
      points.emplace_back(0.2 * x, 0.2 * y, 0.0);
    }
  }
  return points;
}

class AssociationTest : public ::testing::Test {
 protected:
  AssociationTest() { map_.insert_unsided(floor_points()); }

  Association at(const Eigen::Vector3d& point, const Eigen::Vector3f& normal = kUp) {
    return associate(map_, point, normal, options_, context_);
  }

  KdTreeMap map_{0.05};
  KdTreeMap::QueryContext context_;
  AssociationOptions options_;
};

TEST_F(AssociationTest, DistanceIsSignedAlongTheOrientedNormal) {
  const Association above = at({0.03, 0.02, 0.1});
  ASSERT_EQ(above.status, AssociationStatus::kValid);
  EXPECT_NEAR(above.distance, 0.1, 1e-9);
  EXPECT_TRUE(above.normal.isApprox(Eigen::Vector3d::UnitZ()));

  const Association below = at({0.03, 0.02, 0.1}, -kUp);
  EXPECT_NEAR(below.distance, -0.1, 1e-9);
  EXPECT_TRUE(below.normal.isApprox(-Eigen::Vector3d::UnitZ()));
}

TEST_F(AssociationTest, WeightIsThatOfTheDefinition) {
  options_.neighbors = 9;
  const Association centre = at({0.0, 0.0, 0.1});  // nine neighbours in a square: a2D = 1
  const double closeness = std::exp(-0.1 / (0.3 * 5.0));
  EXPECT_NEAR(centre.weight, 0.9 + 0.1 * closeness, 1e-6);
}

TEST_F(AssociationTest, RejectsWithAReason) {
  EXPECT_EQ(at({0.0, 0.0, 0.31}).status, AssociationStatus::kTooFar);
  EXPECT_EQ(at({0.0, 0.0, 5.0}).status, AssociationStatus::kTooFewNeighbors);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(at({nan, 0.0, 0.0}).status, AssociationStatus::kTooFewNeighbors);

  KdTreeMap line(0.05);
  line.insert_unsided(std::vector<Eigen::Vector3d>{
      {0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.2, 0.0, 0.0}, {0.3, 0.0, 0.0}, {0.4, 0.0, 0.0}});
  EXPECT_EQ(
      associate(line, {0.2, 0.0, 0.0}, kUp, options_, context_).status,
      AssociationStatus::kNoPlane);
}

TEST_F(AssociationTest, UnknownNormalGivesAnUnorientedPlane) {
  const Association association = at({0.0, 0.0, 0.1}, Eigen::Vector3f::Zero());
  ASSERT_EQ(association.status, AssociationStatus::kValid);
  EXPECT_NEAR(std::abs(association.distance), 0.1, 1e-9);
}

TEST(AssociationOptions, RefusesWhatMakesNoSense) {
  const auto message = [](auto change) -> std::string {
    AssociationOptions options;
    change(options);
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message([](auto&) {}), "accepted");
  EXPECT_EQ(message([](auto& o) { o.neighbors = 2; }), "nvm: neighbors = 2 must be 3 to 64");
  EXPECT_EQ(
      message([](auto& o) { o.min_neighbors = 21; }),
      "nvm: min_neighbors = 21 must be 3 to neighbors");
  EXPECT_THAT(
      message([](auto& o) { o.max_plane_distance = 0.0; }),
      ::testing::HasSubstr("max_plane_distance"));
  EXPECT_THAT(
      message([](auto& o) { o.max_neighbor_distance = std::nan(""); }),
      ::testing::HasSubstr("max_neighbor_distance"));
  EXPECT_THAT(
      message([](auto& o) { o.planarity_share = 1.5; }), ::testing::HasSubstr("planarity_share"));
}

}  // namespace
}  // namespace nvm
