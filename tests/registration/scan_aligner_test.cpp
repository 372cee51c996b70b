// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/registration/scan_aligner.hpp"

#include <gmock/gmock.h>
#include <tbb/task_arena.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "nvm/core/executor_tbb.hpp"
#include "nvm/map/kd_tree_map.hpp"
#include "support/random_vector.hpp"
#include "support/rng.hpp"
#include "support/room.hpp"

namespace nvm {
namespace {

using test::random_vector;

Pose pose(const Eigen::Vector3d& rotation, const Eigen::Vector3d& translation) {
  Pose result = Pose::Identity();
  result.linear() = so3_exp(rotation);
  result.translation() = translation;
  return result;
}

// The room, mapped from four places.
class ScanAlignerTest : public ::testing::Test {
 protected:
  ScanAlignerTest() {
    for (const double x : {-2.5, -0.8, 0.8, 2.0}) {
      const Pose T_map_scan = pose(Eigen::Vector3d::Zero(), {x, 0.3 * x, 0.0});
      map_.insert_unsided(room_.scan(T_map_scan, 8000, 0.002, rng_).points, T_map_scan);
    }
  }

  std::mt19937_64 rng_ = test::rng();
  test::Room room_;
  KdTreeMap map_{0.1};
  ScanAligner<KdTreeMap> aligner_;
};

TEST_F(ScanAlignerTest, RecoversKnownPoses) {
  for (int seed = 0; seed < 30; ++seed) {
    const Pose truth = pose(0.5 * random_vector(rng_), random_vector(rng_));
    const test::RoomScan scan = room_.scan(truth, 1500, 0.005, rng_);
    const Pose guess = truth * pose(0.05 * random_vector(rng_), 0.15 * random_vector(rng_));
    const AlignResult result = aligner_.align(map_, scan.points, scan.normals, guess);
    EXPECT_EQ(result.status, AlignStatus::kConverged);
    EXPECT_EQ(result.degenerate_directions, 0);
    EXPECT_GT(result.inlier_share(), 0.95);
    const Pose error = truth.inverse() * result.T_map_scan;
    // The map knows no sides: next to the partition it may pull by millimetres.
    EXPECT_LT(error.translation().norm(), 0.01) << "seed " << seed;
    EXPECT_LT(so3_log(error.linear()).norm(), 0.003) << "seed " << seed;
  }
}

TEST_F(ScanAlignerTest, SameBitsForEveryExecutor) {
  const Pose truth = pose(0.3 * random_vector(rng_), random_vector(rng_));
  const test::RoomScan scan = room_.scan(truth, 3000, 0.005, rng_);
  const Pose guess = truth * pose(0.05 * random_vector(rng_), 0.1 * random_vector(rng_));
  const AlignResult serial = aligner_.align(map_, scan.points, scan.normals, guess);
  for (const int threads : {1, 2, 5}) {
    tbb::task_arena arena(threads);
    arena.execute([&] {
      const AlignResult parallel =
          aligner_.align(map_, scan.points, scan.normals, guess, TbbExecutor{});
      EXPECT_EQ(parallel.T_map_scan.matrix(), serial.T_map_scan.matrix());
      EXPECT_EQ(parallel.information, serial.information);
      EXPECT_EQ(parallel.iterations, serial.iterations);
    });
  }
}

TEST_F(ScanAlignerTest, HopelessInputKeepsTheGuess) {
  const Pose guess = pose({0.1, 0.2, 0.3}, {1.0, 0.0, 0.0});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::vector<Eigen::Vector3f>> inputs{
      {},
      {Eigen::Vector3f(1.0F, 0.0F, 0.0F)},
      std::vector<Eigen::Vector3f>(500, Eigen::Vector3f::Constant(nan)),
      std::vector<Eigen::Vector3f>(500, Eigen::Vector3f::Constant(1e6F))};
  for (const auto& points : inputs) {
    const AlignResult result = aligner_.align(map_, points, points, guess);
    EXPECT_EQ(result.status, AlignStatus::kTooFewResiduals);
    EXPECT_EQ(result.T_map_scan.matrix(), guess.matrix());
    EXPECT_EQ(result.counts.total(), points.size());
  }
  const KdTreeMap empty;
  const test::RoomScan scan = room_.scan(Pose::Identity(), 500, 0.0, rng_);
  EXPECT_EQ(
      aligner_.align(empty, scan.points, scan.normals, guess).status,
      AlignStatus::kTooFewResiduals);
}

TEST_F(ScanAlignerTest, OutliersDoNotPull) {
  const Pose truth = pose(0.3 * random_vector(rng_), random_vector(rng_));
  test::RoomScan scan = room_.scan(truth, 1500, 0.005, rng_);
  for (std::size_t i = 0; i < scan.points.size(); i += 4) {
    scan.points[i] *= 0.97F;  // a quarter of the returns comes from something in front of the walls
  }
  const AlignResult result = aligner_.align(map_, scan.points, scan.normals, truth);
  const Pose error = truth.inverse() * result.T_map_scan;
  EXPECT_LT(error.translation().norm(), 0.02);
}

TEST_F(ScanAlignerTest, ALonePlaneIsReportedAsDegenerate) {
  std::uniform_real_distribution<float> uniform(-3.0F, 3.0F);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 4000; ++i) {
    points.emplace_back(uniform(rng_), uniform(rng_), -1.0F);
  }
  const std::vector<Eigen::Vector3f> normals(points.size(), Eigen::Vector3f::UnitZ());
  KdTreeMap plane;
  plane.insert_unsided(points);
  const Pose guess = pose({0.0, 0.0, 0.1}, {0.2, 0.1, 0.05});
  const AlignResult result = aligner_.align(plane, points, normals, guess);
  EXPECT_EQ(result.degenerate_directions, 3);
  EXPECT_NEAR(result.T_map_scan.translation().z(), 0.0, 1e-3);
  EXPECT_NEAR(result.T_map_scan.translation().x(), 0.2, 1e-3);
  EXPECT_NEAR(result.T_map_scan.translation().y(), 0.1, 1e-3);
}

TEST_F(ScanAlignerTest, RefusesBadArguments) {
  const std::vector<Eigen::Vector3f> three(3, Eigen::Vector3f::Ones());
  const std::vector<Eigen::Vector3f> two(2, Eigen::Vector3f::Ones());
  EXPECT_THROW(aligner_.align(map_, three, two, Pose::Identity()), std::invalid_argument);
  Pose scaled = Pose::Identity();
  scaled.linear() *= 1.1;
  EXPECT_THROW(aligner_.align(map_, three, three, scaled), std::invalid_argument);
}

TEST(AlignOptions, RefusesWhatMakesNoSense) {
  const auto refuses = [](auto change, const std::string& name) {
    AlignOptions options;
    change(options);
    try {
      const ScanAligner<KdTreeMap> aligner(options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).find(name) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refuses([](auto& o) { o.max_iterations = 0; }, "max_iterations"));
  EXPECT_TRUE(refuses([](auto& o) { o.converged_rotation = -1.0; }, "converged_rotation"));
  EXPECT_TRUE(refuses([](auto& o) { o.converged_translation = -1.0; }, "converged_translation"));
  EXPECT_TRUE(refuses([](auto& o) { o.min_residuals = 0; }, "min_residuals"));
  EXPECT_TRUE(refuses([](auto& o) { o.min_observability = 2.0; }, "min_observability"));
  EXPECT_TRUE(refuses([](auto& o) { o.association.neighbors = 0; }, "neighbors"));
  EXPECT_TRUE(refuses([](auto& o) { o.kernel.scale = 0.0; }, "kernel"));
}

}  // namespace
}  // namespace nvm
