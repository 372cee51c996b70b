// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/scan/scan_thinning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "support/rng.hpp"

namespace nvm::lio {
namespace {

Scan scan_of(std::size_t size, const std::function<float()>& range) {
  Scan scan{0.0, 0.1, {}};
  for (std::size_t i = 0; i < size; ++i) {
    scan.points.push_back({range(), 0.0F, 0.0F, 0.0F, 0.0F, 0});
  }
  return scan;
}

std::vector<float> kept_ranges(const Scan& scan, const ReturnLimits& limits) {
  std::vector<float> kept;
  ScanThinning thinning(scan, limits);
  for (const TimedPoint& point : scan.points) {
    if (limits.contain(point.sq_range()) && thinning.keeps(point.sq_range())) {
      kept.push_back(point.x);
    }
  }
  return kept;
}

std::size_t count_between(const std::vector<float>& ranges, float low, float high) {
  std::size_t count = 0;
  for (const float range : ranges) {
    count += range >= low && range < high ? 1 : 0;
  }
  return count;
}

TEST(ScanThinning, KeepsAllOfAScanThatIsNotTooLarge) {
  std::mt19937_64 rng = test::rng();
  std::uniform_real_distribution<float> range(1.0F, 60.0F);
  const Scan scan = scan_of(5000, [&] { return range(rng); });
  EXPECT_EQ(kept_ranges(scan, {0.3, 100.0, 5000}).size(), 5000U);
}

TEST(ScanThinning, LeavesAboutAsManyAsAsked) {
  std::mt19937_64 rng = test::rng();
  std::lognormal_distribution<float> range(1.5F, 0.7F);
  const Scan scan = scan_of(100'000, [&] { return range(rng); });
  for (const std::size_t max_count : {5000U, 20'000U, 70'000U, 99'000U}) {
    const auto kept = static_cast<double>(kept_ranges(scan, {0.3, 1000.0, max_count}).size());
    EXPECT_NEAR(kept / static_cast<double>(max_count), 1.0, 0.1) << max_count;
  }
}

TEST(ScanThinning, ThinsTheNearAndLeavesTheFar) {
  std::mt19937_64 rng = test::rng();
  std::uniform_real_distribution<float> range(1.0F, 41.0F);
  const Scan scan = scan_of(100'000, [&] { return range(rng); });
  const std::vector<float> kept = kept_ranges(scan, {0.3, 100.0, 80'000});
  std::vector<float> all;
  for (const TimedPoint& point : scan.points) {
    all.push_back(point.x);
  }
  EXPECT_EQ(count_between(kept, 35.0F, 50.0F), count_between(all, 35.0F, 50.0F));
  const auto share = [&](float low, float high) {
    return static_cast<double>(count_between(kept, low, high)) /
           static_cast<double>(count_between(all, low, high));
  };
  EXPECT_NEAR(share(10.0F, 10.5F) / share(5.0F, 5.5F), 3.81, 0.5);  // the square of 10.25 / 5.25
}

TEST(ScanThinning, IsNotTakenInByWhatIsOutOfLimits) {
  std::mt19937_64 rng = test::rng();
  std::uniform_real_distribution<float> range(1.0F, 40.0F);
  int i = 0;
  const Scan scan = scan_of(30'000, [&] {  // two of three returns are none
    ++i;
    return i % 3 == 0 ? range(rng) : i % 3 == 1 ? 0.0F : std::numeric_limits<float>::quiet_NaN();
  });
  EXPECT_EQ(kept_ranges(scan, {0.3, 100.0, 20'000}).size(), 10'000U);
  EXPECT_NEAR(static_cast<double>(kept_ranges(scan, {0.3, 100.0, 5000}).size()), 5000.0, 250.0);
  EXPECT_TRUE(kept_ranges(scan, {50.0, 100.0, 5000}).empty());
}

}  // namespace
}  // namespace nvm::lio
