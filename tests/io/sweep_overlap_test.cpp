// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/sweep_overlap.hpp"

#include <gmock/gmock.h>

#include <random>
#include <stdexcept>

#include "support/rng.hpp"

namespace nvm::io {
namespace {

using ::testing::HasSubstr;

constexpr double kSweep = 0.1;  // [s]

Scan sweep(double begin) { return {begin, begin + kSweep, {}}; }

// The beginnings of those that are kept.
std::vector<double> kept(const std::vector<Scan>& sweeps, std::string* note = nullptr) {
  SweepOverlap overlap;
  const std::string said = overlap.learn({sweeps.begin(), sweeps.begin() + 20});
  if (note != nullptr) {
    *note = said;
  }
  std::vector<double> kept;
  for (const Scan& scan : sweeps) {
    try {
      overlap.check(scan);
      kept.push_back(scan.t_begin);
    } catch (const std::runtime_error&) {
      continue;
    }
  }
  return kept;
}

TEST(SweepOverlap, KeepsToOneOfTwoLidars) {
  for (const double behind : {0.01, 0.05, 0.09}) {
    std::vector<Scan> both;
    std::vector<double> one;
    for (int i = 0; i < 50; ++i) {
      both.push_back(sweep(kSweep * i));
      both.push_back(sweep(kSweep * i + behind));
      one.push_back(kSweep * i);
    }
    std::string note;
    EXPECT_EQ(kept(both, &note), one) << behind;
    EXPECT_THAT(note, HasSubstr("they last 0.100 s and begin 0.0")) << behind;
  }
}

TEST(SweepOverlap, KeepsAllOfOneLidarWhateverItsStampsJitter) {
  auto rng = test::rng();
  std::uniform_real_distribution<double> jitter(-0.04, 0.04);
  for (int seed = 0; seed < 20; ++seed) {
    std::vector<Scan> sweeps;
    for (int i = 0; i < 50; ++i) {
      sweeps.push_back(sweep(kSweep * i + jitter(rng)));
    }
    EXPECT_EQ(kept(sweeps).size(), sweeps.size()) << seed;
  }
}

TEST(SweepOverlap, GoesOnWithTheOtherWhereOneFallsSilent) {
  std::vector<Scan> sweeps;
  for (int i = 0; i < 50; ++i) {
    if (i < 25) {
      sweeps.push_back(sweep(kSweep * i));
    }
    sweeps.push_back(sweep(kSweep * i + 0.05));
  }
  EXPECT_EQ(kept(sweeps).size(), 50U);
}

TEST(SweepOverlap, CloudsWithoutTimesOverlapNothing) {
  std::vector<Scan> clouds;
  for (int i = 0; i < 50; ++i) {
    clouds.push_back({kSweep * i, kSweep * i, {}});
  }
  EXPECT_EQ(kept(clouds).size(), clouds.size());
}

}  // namespace
}  // namespace nvm::io
