// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/alternating_views.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "support/rng.hpp"

namespace nvm::io {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kPeriod = 0.1;  // [s]
constexpr double kPi = 3.14159265358979323846;

/// What a LiDAR sees of a room of 9 x 4 x 2.6 m: 2000 returns in random directions up to 45 degrees
/// from level, `from` to `to` its own azimuth [rad].
class OblongRoom {
 public:
  Scan scan(double time, double yaw, double x, double from = -kPi, double to = kPi) {
    std::uniform_real_distribution<double> azimuth(from, to), sine(-0.7, 0.7);
    Scan scan{time, time, {}};
    for (int i = 0; i < 2000; ++i) {
      const double own = azimuth(rng_);
      const double up = sine(rng_);
      const double level = std::sqrt(1.0 - up * up);
      const double range = std::min(
          {reach(level * std::cos(own + yaw), x, 4.5),
           reach(level * std::sin(own + yaw), 0.3, 2.0),
           reach(up, 0.1, 1.3)});
      TimedPoint point;
      point.x = static_cast<float>(range * level * std::cos(own));
      point.y = static_cast<float>(range * level * std::sin(own));
      point.z = static_cast<float>(range * up);
      scan.points.push_back(point);
    }
    return scan;
  }

 private:
  static double reach(double direction, double position, double half) {
    return (std::copysign(half, direction) - position) / direction;
  }

  std::mt19937_64 rng_ = test::rng();
};

/// Times of those that are kept.
std::vector<double> kept_times(const std::vector<Scan>& scans, std::string* said = nullptr) {
  AlternatingViews views;
  const std::string note = views.learn({scans.begin(), scans.begin() + 20});
  if (said != nullptr) {
    *said = note;
  }
  std::vector<double> kept;
  for (const Scan& scan : scans) {
    try {
      views.check(scan);
      kept.push_back(scan.t_begin);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("another LiDAR"));
    }
  }
  return kept;
}

TEST(AlternatingViews, KeepsToOneOfTwoLidars) {
  for (const double second : {0.5 * kPi, kPi, 2.0}) {  // how it is turned against the first
    OblongRoom room;
    std::vector<Scan> both;
    std::vector<double> first;
    for (int i = 0; i < 60; ++i) {
      const double time = kPeriod * i;
      const double yaw = 0.05 * i;
      const double x = -3.0 + 0.1 * i;
      both.push_back(room.scan(time, yaw, x));
      both.push_back(room.scan(time + 0.05, yaw + second, x + 0.3));
      first.push_back(time);
    }
    std::string said;
    EXPECT_EQ(kept_times(both, &said), first) << second;
    EXPECT_THAT(said, HasSubstr("two LiDARs")) << second;
  }
}

TEST(AlternatingViews, KeepsAllOfOneLidarHoweverItMoves) {
  for (const double turn : {0.0, 0.05, 0.3, 0.5 * kPi}) {  // from cloud to cloud [rad]
    OblongRoom room;
    std::vector<Scan> scans;
    for (int i = 0; i < 60; ++i) {
      scans.push_back(room.scan(kPeriod * i, turn * i, -3.0 + 0.1 * i));
    }
    std::string said;
    EXPECT_EQ(kept_times(scans, &said).size(), scans.size()) << turn;
    EXPECT_THAT(said, IsEmpty()) << turn;
  }
}

TEST(AlternatingViews, KeepsBothHalvesOfSweeps) {
  OblongRoom room;
  std::vector<Scan> halves;
  for (int i = 0; i < 60; ++i) {
    const double from = i % 2 == 0 ? -kPi : 0.0;
    halves.push_back(room.scan(kPeriod * i, 0.02 * i, -3.0 + 0.1 * i, from, from + kPi));
  }
  EXPECT_EQ(kept_times(halves).size(), halves.size());
}

TEST(AlternatingViews, GoesOnWithTheOtherWhereOneFallsSilent) {
  OblongRoom room;
  std::vector<Scan> scans;
  for (int i = 0; i < 60; ++i) {
    if (i < 20) {
      scans.push_back(room.scan(kPeriod * i, 0.0, -1.0));
    }
    scans.push_back(room.scan(kPeriod * i + 0.05, 0.5 * kPi, -1.0));
  }
  const std::vector<double> times = kept_times(scans);
  EXPECT_THAT(times, ::testing::SizeIs(::testing::AllOf(::testing::Ge(48U), ::testing::Le(52U))));
  EXPECT_GT(times.back(), 5.9);
}

TEST(AlternatingViews, OfEmptyCloudsAreNone) {
  std::vector<Scan> scans(30, Scan{0.0, 0.0, {}});
  scans[3].points.resize(7);
  EXPECT_EQ(kept_times(scans).size(), scans.size());
}

}  // namespace
}  // namespace nvm::io
