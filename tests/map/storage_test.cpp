// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "nvm/map/storage/brick_table.hpp"
#include "nvm/map/storage/byte_stream.hpp"
#include "nvm/map/storage/lanes.hpp"
#include "nvm/map/storage/lattice.hpp"
#include "nvm/map/storage/principal_direction.hpp"
#include "support/random_cloud.hpp"
#include "support/rng.hpp"

namespace nvm::detail {
namespace {

TEST(Lattice, TakesTheFloorAlongEveryAxis) {
  const Lattice lattice(0.5);
  const auto voxel_of = [&](double x) {
    LatticePoint point;
    EXPECT_EQ(lattice.locate({x, -x, 0.0}, point), LatticeStatus::kInside);
    return point.voxel;
  };
  EXPECT_EQ(voxel_of(0.0), VoxelIndex(0, 0, 0));
  EXPECT_EQ(voxel_of(0.49), VoxelIndex(0, -1, 0));  // truncation would give 0 for both
  EXPECT_EQ(voxel_of(0.5), VoxelIndex(1, -1, 0));   // a point on a face belongs to the upper voxel
  EXPECT_EQ(voxel_of(1.2), VoxelIndex(2, -3, 0));
  EXPECT_EQ(voxel_of(524287.9), VoxelIndex(1048575, -1048576, 0));
}

TEST(Lattice, ReportsWhatItCannotHold) {
  const Lattice lattice(0.5);
  LatticePoint point;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(lattice.locate({524288.0, 0, 0}, point), LatticeStatus::kOutOfRange);
  EXPECT_EQ(lattice.locate({0, -1e300, 0}, point), LatticeStatus::kOutOfRange);
  EXPECT_EQ(lattice.locate({0, 0, kNan}, point), LatticeStatus::kNonFinite);
  EXPECT_EQ(lattice.locate({kNan, 1e300, 0}, point), LatticeStatus::kNonFinite);
  EXPECT_EQ(lattice.locate({0, HUGE_VAL, 0}, point), LatticeStatus::kNonFinite);
}

TEST(Lattice, PositionsComeBackWithinHalfAStep) {
  std::mt19937_64 rng = test::rng();
  for (const double voxel_size : {0.1, 0.3, 1.0, 2.0}) {
    const Lattice lattice(voxel_size);
    std::uniform_real_distribution<double> u(-1e5, 1e5);
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d position(u(rng), u(rng), u(rng));
      LatticePoint point{{0, 0, 0}, {0, 0, 0}};
      ASSERT_EQ(lattice.locate(position, point), LatticeStatus::kInside);
      const Eigen::Vector3d error = lattice.position(point.voxel, point.step) - position;
      EXPECT_LT(error.cwiseAbs().maxCoeff(), 0.5001 * lattice.meters_per_step());
    }
  }
}

TEST(IndexKey, RoundTripsAndIsGolden) {
  std::mt19937_64 rng = test::rng();
  std::uniform_int_distribution<int> u(-kMaxVoxelIndex, kMaxVoxelIndex - 1);
  for (int i = 0; i < 1000; ++i) {
    const VoxelIndex index(u(rng), u(rng), u(rng));
    EXPECT_EQ(index_of_key(index_key(index)), index);
    EXPECT_EQ(voxel_index(index_key(brick_index(index)), cell_in_brick(index)), index);
  }
  EXPECT_EQ(
      index_key({0, 0, 0}),
      0x8000000000000000ULL);  // saved nowhere, but a change must be deliberate
  EXPECT_EQ(index_key({1, -1, 2}), 0x80000bffffe00001ULL);
}

TEST(BrickTable, AgreesWithUnorderedMap) {
  std::mt19937_64 rng = test::rng();
  BrickTable table;
  std::unordered_map<IndexKey, std::uint32_t> model;
  for (std::uint32_t step = 0; step < 60000; ++step) {
    // A small key space, so that keys come back and probe sequences are long.
    const VoxelIndex index(
        static_cast<int>(rng() % 30),
        static_cast<int>(rng() % 30) - 15,
        static_cast<int>(rng() % 30));
    const IndexKey key = index_key(index);
    const auto found = model.find(key);
    ASSERT_EQ(table.find(key), found == model.end() ? kNone : found->second);
    if (found == model.end()) {
      table.insert(key, step);
      model[key] = step;
    } else if (rng() % 2 == 0) {
      table.erase(key);
      model.erase(found);
    }
  }
  for (const auto& [key, brick] : model) {
    ASSERT_EQ(table.find(key), brick);
  }
}

TEST(Lanes, EveryVariantEqualsPlainLoops) {
  std::mt19937_64 rng = test::rng();
  for (int round = 0; round < 5000; ++round) {
    PointChunk chunk{};
    const auto coordinate = [&] {
      return static_cast<std::int16_t>(static_cast<std::uint16_t>(rng()));
    };
    const WrappedPoint query{coordinate(), coordinate(), coordinate()};
    std::array<std::int32_t, kLanes> expected;
    for (int lane = 0; lane < kLanes; ++lane) {
      // Less than 4 voxels apart in each axis; the sum wraps around as stored coordinates do.
      const auto apart = [&] { return static_cast<int>(rng() % 32767) - 16383; };
      const std::array<int, 3> d{apart(), apart(), apart()};
      const auto moved = [](std::int16_t from, int by) {
        return static_cast<std::int16_t>(static_cast<std::uint16_t>(from + by));
      };
      chunk.set_position(lane, {moved(query.x, d[0]), moved(query.y, d[1]), moved(query.z, d[2])});
      expected[static_cast<std::size_t>(lane)] = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    }
    IntLanes distances;
    sq_distances(chunk, LanePoint(query), distances);
    const auto limit = static_cast<std::int32_t>(rng() % (1U << 30));
    const std::uint32_t below = lanes_below(distances, limit);
    std::array<std::int32_t, 2 * kLanes> compressed;
    compress(below, distances, compressed.data());
    std::size_t next = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int32_t distance = expected[static_cast<std::size_t>(lane)];
      ASSERT_EQ(distances[lane], distance);
      ASSERT_EQ((below >> lane & 1U) != 0, distance < limit);
      if (distance < limit) {
        ASSERT_EQ(compressed[next++], distance);
      }
    }
  }
}

TEST(PrincipalDirection, IsTheDominantEigenvectorWithTheSignOfTheSum) {
  std::mt19937_64 rng = test::rng();
  int checked = 0;
  for (int round = 0; round < 20000; ++round) {
    const Eigen::Vector3f axis = test::random_unit(rng);
    const float scatter = 0.01F * static_cast<float>(rng() % 200);
    NormalSums sums;
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t count = 1 + rng() % 120;
    for (std::size_t i = 0; i < count; ++i) {
      const StoredNormal normal =
          store_normal((axis + scatter * test::random_unit(rng)).normalized());
      sums.add(normal);
      const Eigen::Vector3d n(normal.x, normal.y, normal.z);
      matrix += n * n.transpose();
      sum += n;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    Eigen::Vector3d expected = solver.eigenvectors().col(2);
    if (expected.dot(sum) < 0.0) {
      expected = -expected;
    }
    if (solver.eigenvalues()[1] > 0.8 * solver.eigenvalues()[2] || expected.dot(sum) < 1.0) {
      continue;  // no distinct direction, or no sign
    }
    ++checked;
    const Eigen::Vector3d direction = load_normal(principal_direction(sums)).cast<double>();
    const double ratio = solver.eigenvalues()[1] / solver.eigenvalues()[2];
    const double bound = 0.008 + 0.035 / (1.0 - ratio);  // rounding, and what a step may turn it
    ASSERT_GT(direction.dot(expected), std::cos(bound)) << solver.eigenvalues().transpose();
  }
  EXPECT_GT(checked, 15000);
  EXPECT_EQ(principal_direction(NormalSums{}), StoredNormal{});
}

TEST(StoredNormal, IsAccurateAndItsThresholdsAreCosines) {
  std::mt19937_64 rng = test::rng();
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3f normal = test::random_unit(rng);
    const Eigen::Vector3f stored = load_normal(store_normal(normal));
    ASSERT_GT(stored.dot(normal), std::cos(0.0072F));  // 0.41 degrees
  }
  EXPECT_EQ(dot_threshold(kTightAngle), kTightDot);
  EXPECT_EQ(dot_threshold(1.5707963267948966), 0);
  EXPECT_EQ(load_normal(StoredNormal{}), Eigen::Vector3f::Zero());
}

TEST(Crc32, IsTheOneOfZipAndPng) {
  const std::vector<std::uint8_t> digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc32(digits.data(), digits.size()), 0xcbf43926U);
}

}  // namespace
}  // namespace nvm::detail
