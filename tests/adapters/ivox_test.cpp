// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/ivox/ivox.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <execution>
#include <memory>
#include <numeric>
#include <thread>

#include "adapters/host_point.hpp"
#include "adapters/reference_search.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"
#include "support/sanitizers.hpp"

namespace faster_lio {
namespace {

namespace test = nvm::test;

// The names that the host uses.
using PointType = test::HostPoint;
using PointVector = test::HostPoints;
using IVoxType = IVox<3, IVoxNodeType::PHC, PointType>;

/// Every call of faster-lio's LaserMapping to its map.
class Host {
 public:
  explicit Host(int nearby_type) {
    float& resolution = ivox_options_.resolution_;  // nh.param<float>(name, this, 0.2)
    resolution = 0.3F;
    if (nearby_type == 0) {
      ivox_options_.nearby_type_ = IVoxType::NearbyType::CENTER;
    } else if (nearby_type == 6) {
      ivox_options_.nearby_type_ = IVoxType::NearbyType::NEARBY6;
    } else if (nearby_type == 18) {
      ivox_options_.nearby_type_ = IVoxType::NearbyType::NEARBY18;
    } else {
      ivox_options_.nearby_type_ = IVoxType::NearbyType::NEARBY26;
    }
  }
  void start() { ivox_ = std::make_shared<IVoxType>(ivox_options_); }
  void add(const PointVector& points) { ivox_->AddPoints(points); }

  void search(const PointVector& scan_world) {
    nearest_points_.resize(scan_world.size());
    std::vector<std::size_t> index(scan_world.size());
    std::iota(index.begin(), index.end(), std::size_t{0});
    std::for_each(std::execution::par_unseq, index.begin(), index.end(), [&](const std::size_t& i) {
      nearest_points_[i].clear();
      ivox_->GetClosestPoint(scan_world[i], nearest_points_[i], 5);
    });
  }

  IVoxType::Options ivox_options_;
  std::shared_ptr<IVoxType> ivox_ = nullptr;
  std::vector<PointVector> nearest_points_;
};

TEST(IVox, TransparentFindsWhatIVoxDoes) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("the standard library's parallel algorithms");
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(3000, 3.0, {0, 0, 0}, rng);
  const std::vector<Eigen::Vector3d> queries = test::uniform_cloud(200, 3.2, {0, 0, 0}, rng).points;
  for (const int nearby_type : {0, 6, 18, 26}) {
    for (const KeyRounding rounding : {KeyRounding::kRound, KeyRounding::kFloor}) {
      Host host(nearby_type);
      host.ivox_options_.transparent = true;
      host.ivox_options_.key_rounding = rounding;
      host.start();
      host.add(test::host_points(cloud.points));
      host.search(test::host_points(queries));
      EXPECT_EQ(host.ivox_->NumPoints(), cloud.points.size());
      const auto key = [&](const Eigen::Vector3d& p) {
        const Eigen::Array3d scaled = p.array() / static_cast<double>(0.3F);
        const double shift = rounding == KeyRounding::kRound ? 0.5 : 0.0;
        return Eigen::Array3d((scaled + shift).floor());
      };
      const double steps = std::array<double, 4>{
          0.0, 1.0, 2.0, 3.0}[static_cast<std::size_t>(host.ivox_options_.nearby_type_)];
      for (std::size_t i = 0; i < queries.size(); ++i) {
        const std::vector<double> expected =
            test::nearest_distances(cloud.points, queries[i], 5, [&](const Eigen::Vector3d& p) {
              const Eigen::Array3d apart = (key(p) - key(queries[i])).abs();
              return apart.maxCoeff() <= 1.0 && apart.sum() <= steps;
            });
        ASSERT_EQ(host.nearest_points_[i].size(), expected.size()) << nearby_type;
        for (std::size_t j = 0; j < expected.size(); ++j) {
          EXPECT_NEAR(
              (nvm::position(host.nearest_points_[i][j]) - queries[i]).norm(),
              expected[j],
              test::kLattice);
        }
      }
    }
  }
}

TEST(IVox, NormalsKeepTheSidesOfAWallApart) {
  NVM_SKIP_UNDER_THREAD_SANITIZER("the standard library's parallel algorithms");
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(3000, 0.05, rng);
  Host host(18);
  host.start();
  const PointVector points = test::host_points_with_normals(wall);
  host.add(points);
  host.search(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_FALSE(host.nearest_points_[i].empty());
    for (const PointType& found : host.nearest_points_[i]) {
      EXPECT_EQ(found.y > test::kWallY, wall.normals[i].y() > 0.0F);
    }
  }
}

TEST(IVox, AViewPointIsEnoughToKeepTheSidesApart) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud wall = test::thin_wall(3000, 0.05, rng);
  PointVector front, back;
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    (wall.normals[i].y() > 0.0F ? front : back).push_back(test::host_point(wall.points[i]));
  }
  Host host(18);
  host.start();
  host.ivox_->set_view_point(0.0, 4.0, 0.0);
  host.add(front);
  host.ivox_->set_view_point(0.0, -4.0, 0.0);
  host.add(back);
  PointVector closest;
  for (const PointType& query : back) {
    ASSERT_TRUE(host.ivox_->GetClosestPoint(query, closest, 5));
    for (const PointType& found : closest) {
      EXPECT_LT(found.y, test::kWallY);
    }
  }
}

TEST(IVox, AFailedQueryLeavesNoNeighborsOfAnEarlierOne) {
  Host host(6);
  host.start();
  PointVector closest{test::host_point({9, 9, 9})};
  EXPECT_FALSE(host.ivox_->GetClosestPoint(test::host_point({0, 0, 0}), closest));
  EXPECT_TRUE(closest.empty());
  host.add({test::host_point({0, 0, 0})});
  EXPECT_EQ(host.ivox_->NumValidGrids(), 1U);
  EXPECT_TRUE(host.ivox_->GetClosestPoint(test::host_point({0, 0, 0.1}), closest, 5, 5.0));
  EXPECT_EQ(closest.size(), 1U);
  EXPECT_FALSE(host.ivox_->GetClosestPoint(test::host_point({0, 0, 0.1}), closest, 5, 0.01));
}

TEST(IVox, OptionsAreChecked) {
  IVoxType::Options options;
  options.resolution_ = 0.0F;
  EXPECT_THROW(IVoxType{options}, std::invalid_argument);
  options.resolution_ = 0.3F;
  EXPECT_EQ(IVoxType(options).density_warning(), "");
  options.resolution_ = 0.1F;  // with filter_size_map 0.3: faster-lio's mid360.yaml
  EXPECT_EQ(IVoxType(options).density_warning(), "");
  options.nvm.map.min_point_distance = 0.2;
  EXPECT_THAT(IVoxType(options).density_warning(), testing::HasSubstr("5 neighbours"));
}

// Run under ThreadSanitizer.
TEST(IVox, QueriesFromManyThreadsAgreeWithOneThread) {
  std::mt19937_64 rng = test::rng();
  const test::Cloud cloud = test::uniform_cloud(4000, 3.0, {0, 0, 0}, rng);
  for (const bool transparent : {false, true}) {
    Host host(18);
    host.ivox_options_.transparent = transparent;
    host.start();
    const PointVector points = test::host_points_with_normals(cloud);
    host.add(points);
    const auto ask = [&](std::vector<float>& answers) {
      PointVector closest;
      for (std::size_t i = 0; i < 1000; ++i) {
        host.ivox_->GetClosestPoint(points[i], closest);
        for (const PointType& point : closest) {
          answers.push_back(point.x);
        }
      }
    };
    std::vector<float> alone;
    ask(alone);
    std::array<std::vector<float>, 4> together;
    std::vector<std::thread> threads;
    for (std::vector<float>& answers : together) {
      threads.emplace_back([&] { ask(answers); });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
    EXPECT_THAT(together, testing::Each(alone));
  }
}

}  // namespace
}  // namespace faster_lio
