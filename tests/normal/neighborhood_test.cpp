// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Neighbourhoods against brute force: the same neighbours, whatever the points.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "nvm/core/executor.hpp"
#include "nvm/normal/block_search.hpp"
#include "nvm/normal/block_tree.hpp"
#include "nvm/normal/spatial_sorter.hpp"
#include "support/rng.hpp"

namespace nvm::detail {
namespace {

using Rng = std::mt19937_64;

struct Input {
  std::string name;
  std::function<LocalPoints(Rng&)> make;
  double resolution;
  bool sums_are_exact;  // coordinates and radii so round that float sums have no rounding
};

void add(LocalPoints& points, double x, double y, double z, double radius) {
  points.x.push_back(static_cast<float>(x));
  points.y.push_back(static_cast<float>(y));
  points.z.push_back(static_cast<float>(z));
  points.sq_radius.push_back(static_cast<float>(radius) * static_cast<float>(radius));
}

LocalPoints uniform(
    Rng& rng, std::size_t count, double size, double min_radius, double max_radius) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  LocalPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    add(points,
        size * unit(rng),
        size * unit(rng),
        size * unit(rng),
        min_radius + (max_radius - min_radius) * unit(rng));
  }
  return points;
}

// Every neighbour at distance 1 or 2 lies exactly at the radius.
LocalPoints integer_grid(Rng& rng) {
  LocalPoints points;
  for (int x = 0; x < 12; ++x) {
    for (int y = 0; y < 12; ++y) {
      for (int z = 0; z < 6; ++z) {
        add(points, x, y, z, 1.0 + static_cast<double>(rng() % 2));
      }
    }
  }
  return points;
}

LocalPoints duplicates(Rng& rng) {
  LocalPoints points;
  for (int i = 0; i < 1500; ++i) {
    add(points,
        static_cast<double>(rng() % 3),
        static_cast<double>(rng() % 2),
        static_cast<double>(rng() % 4),
        1.0);
  }
  return points;
}

LocalPoints plane_and_outliers(Rng& rng) {
  LocalPoints points = uniform(rng, 1500, 3.0, 0.2, 0.6);
  for (float& z : points.z) {
    z *= 0.01F;
  }
  add(points, 1e4, -1e4, 1e4, 0.3);
  add(points, -1e4, 1e4, 1e4, 0.3);
  return points;
}

const Input kInputs[] = {
    {"Empty", [](Rng&) { return LocalPoints(); }, 0.1, true},
    {"OnePoint", [](Rng& rng) { return uniform(rng, 1, 1.0, 0.5, 0.5); }, 0.1, false},
    {"FewPoints", [](Rng& rng) { return uniform(rng, 7, 1.0, 0.5, 0.9); }, 0.1, false},
    {"UniformFixed", [](Rng& rng) { return uniform(rng, 3000, 4.0, 0.5, 0.5); }, 0.1, false},
    {"UniformAdaptive", [](Rng& rng) { return uniform(rng, 3000, 4.0, 0.05, 2.0); }, 0.01, false},
    {"AllWithinReach", [](Rng& rng) { return uniform(rng, 700, 1.0, 3.0, 3.0); }, 0.1, false},
    {"NoneWithinReach", [](Rng& rng) { return uniform(rng, 500, 1e3, 0.01, 0.01); }, 0.01, false},
    {"CoarseOrder", [](Rng& rng) { return uniform(rng, 2000, 4.0, 0.3, 0.6); }, 100.0, false},
    {"IntegerGrid", integer_grid, 0.25, true},
    {"Duplicates", duplicates, 0.25, true},
    {"PlaneAndOutliers", plane_and_outliers, 0.05, false}};

Moments<double> brute_force(const LocalPoints& points, std::size_t query) {
  Moments<double> moments;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const float dx = points.x[i] - points.x[query];
    const float dy = points.y[i] - points.y[query];
    const float dz = points.z[i] - points.z[query];
    if (sq_length(dx, dy, dz) <= points.sq_radius[query]) {
      moments.add(1.0, dx, dy, dz);
    }
  }
  return moments;
}

std::vector<double> values(const Moments<double>& m) {
  return {m.count, m.x, m.y, m.z, m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
}

Moments<double> lane(const Moments<FloatLanes>& m, std::size_t i) {
  return {m.count[i], m.x[i], m.y[i], m.z[i], m.xx[i], m.xy[i], m.xz[i], m.yy[i], m.yz[i], m.zz[i]};
}

class Neighborhood : public ::testing::TestWithParam<Input> {
 protected:
  Neighborhood() : rng_(test::rng()), points_(GetParam().make(rng_)) {
    const std::vector<NormalStatus> status(points_.x.size(), NormalStatus::kValid);
    SpatialSorter().sort(points_, status, GetParam().resolution, sorted_);
  }

  template <class Search>
  void expect_brute_force(const Search& search) const {
    for (std::size_t block = 0; block < QueryBlock::count(sorted_); ++block) {
      const QueryBlock query(sorted_, block);
      Moments<FloatLanes> sums;
      search(query, sums);
      for (std::size_t i = 0; i < query.end - query.begin; ++i) {
        const std::uint32_t point = sorted_.index[query.begin + i];
        expect_equal(lane(sums, i), brute_force(points_, point), points_.sq_radius[point]);
      }
    }
  }

  static void expect_equal(
      const Moments<double>& actual, const Moments<double>& expected, double sq_radius) {
    ASSERT_EQ(actual.count, expected.count);
    const double tolerance =
        GetParam().sums_are_exact ? 0.0 : 1e-5 * expected.count * std::max(1.0, sq_radius);
    for (std::size_t i = 1; i < values(expected).size(); ++i) {
      ASSERT_NEAR(values(actual)[i], values(expected)[i], tolerance) << i;
    }
  }

  Rng rng_;
  LocalPoints points_;
  SortedPoints sorted_;
};

TEST_P(Neighborhood, OfTheBlockTreeIsThatOfBruteForce) {
  BlockTree tree;
  tree.build(PointItems{sorted_}, SerialExecutor());
  expect_brute_force(BlockSearch(PointItems{sorted_}, tree));
}

TEST_P(Neighborhood, StaysTheSameWhenTheTreeIsBuiltAgain) {
  BlockTree tree;
  SortedPoints other;
  Rng rng = test::rng();
  const LocalPoints points = uniform(rng, 5000, 1.0, 0.1, 0.1);
  SpatialSorter().sort(points, std::vector<NormalStatus>(5000, NormalStatus::kValid), 0.1, other);
  tree.build(PointItems{other}, SerialExecutor());
  tree.build(PointItems{sorted_}, SerialExecutor());
  expect_brute_force(BlockSearch(PointItems{sorted_}, tree));
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, Neighborhood, ::testing::ValuesIn(kInputs), [](const auto& instance) {
      return instance.param.name;
    });

TEST(SpatialSorter, KeepsEveryValidPointOnce) {
  Rng rng = test::rng();
  const LocalPoints points = uniform(rng, 1001, 5.0, 0.1, 0.1);
  std::vector<NormalStatus> status(1001, NormalStatus::kValid);
  status[3] = status[500] = NormalStatus::kTooFar;
  SortedPoints sorted;
  SpatialSorter().sort(points, status, 0.05, sorted);
  ASSERT_EQ(sorted.size(), 999U);
  std::vector<bool> seen(1001, false);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_FALSE(seen[sorted.index[i]]);
    seen[sorted.index[i]] = true;
    EXPECT_EQ(sorted.x[i], points.x[sorted.index[i]]);
  }
  EXPECT_FALSE(seen[3] || seen[500]);
}

TEST(RadixSort, IsStableAndEqualsStdStableSort) {
  Rng rng = test::rng();
  for (const int bits : {1, 11, 12, 40, 63}) {
    std::vector<KeyedIndex> items, scratch;
    for (std::uint32_t i = 0; i < 5000; ++i) {
      items.push_back({(rng() >> 1) >> (63 - bits), i});
    }
    std::vector<KeyedIndex> expected = items;
    std::stable_sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) {
      return a.key < b.key;
    });
    radix_sort(items, scratch, bits);
    for (std::size_t i = 0; i < items.size(); ++i) {
      ASSERT_EQ(items[i].index, expected[i].index);
    }
  }
}

}  // namespace
}  // namespace nvm::detail
