// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/prediction_watch.hpp"

#include <gmock/gmock.h>

namespace nvm::lio {
namespace {

constexpr double kFast = 0.005;  // between readings [s]

/// A filter at `x` [m], 1 mm unsure of its position as a whole.
ErrorStateFilter filter_at(double x) {
  NavState state;
  state.T_world_body.translation().x() = x;
  NavCovariance covariance = NavCovariance::Zero();
  covariance(kPosition, kPosition) = 1e-6;
  return {state, covariance, ImuNoise()};
}

struct Watched {
  PredictionWatch watch;
  void see(double correction, double share = 1.0, double interval = kFast) {
    watch.add(filter_at(0.0), filter_at(correction), share, interval);
  }
};

TEST(PredictionWatch, DoubtsWhatTheFilterDidNotExpect) {
  Watched watched;
  watched.see(0.0029);
  EXPECT_FALSE(watched.watch.is_doubtful());
  watched.see(0.0033);
  EXPECT_TRUE(watched.watch.is_doubtful());
  watched.see(0.0033, 1.0, 0.05);  // a slow IMU misses as much
  EXPECT_FALSE(watched.watch.is_doubtful());
}

TEST(PredictionWatch, DoubtsABadFitThatWasCorrected) {
  Watched watched;
  watched.see(0.0);
  watched.see(0.0005, 0.8);  // at the edge of the map
  EXPECT_FALSE(watched.watch.is_doubtful());
  watched.see(0.0015, 0.8);
  EXPECT_TRUE(watched.watch.is_doubtful());
  watched.see(0.0015, 0.95);
  EXPECT_FALSE(watched.watch.is_doubtful());
}

TEST(PredictionWatch, TellsWhatIsUnexpectedAgainAndAgain) {
  EXPECT_EQ(PredictionWatch().finding(), "");
  Watched watched;
  for (int i = 0; i < 100; ++i) {
    watched.see(i % 25 == 0 ? 0.006 : 0.001);
  }
  EXPECT_EQ(watched.watch.finding(), "");  // four times
  for (int i = 0; i < 100; ++i) {
    watched.see(i % 25 == 0 ? 0.012 : 0.001);
  }
  EXPECT_THAT(watched.watch.finding(), ::testing::HasSubstr("4 % of the scans the IMU leads"));
  EXPECT_THAT(watched.watch.finding(), ::testing::HasSubstr("12 mm"));
}

}  // namespace
}  // namespace nvm::lio
