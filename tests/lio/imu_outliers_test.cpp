// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "lio/imu/imu_buffer.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

/// A sensor that is carried: turning, swaying, noise as MEMS have it.
class Carried {
 public:
  ImuSample at(double time) {
    const auto noise = [&](double deviation) {
      return Eigen::Vector3d(
          deviation * normal_(generator_),
          deviation * normal_(generator_),
          deviation * normal_(generator_));
    };
    const double sway = std::sin(9.0 * time);
    return {
        time,
        Eigen::Vector3d(0.2 * sway, -0.3, 0.8 * std::cos(2.0 * time)) + noise(0.005),
        Eigen::Vector3d(1.5 * sway, 0.4, 9.8 + 2.0 * std::cos(11.0 * time)) + noise(0.05)};
  }

 private:
  std::mt19937_64 generator_ = test::rng();
  std::normal_distribution<double> normal_{0.0, 1.0};
};

using Change = std::function<void(double, ImuSample&)>;

/// 3 s at `rate` [Hz], changed.
ImuBuffer fill(double rate, const Change& change) {
  Carried carried;
  ImuBuffer buffer;
  for (int i = 0; i < 3.0 * rate; ++i) {
    ImuSample sample = carried.at(i / rate);
    change(sample.time, sample);
    buffer.add(sample);
  }
  return buffer;
}

struct Burst {
  std::string name;
  std::function<void(ImuSample&)> spoil;
};

std::vector<Burst> bursts() {
  return {
      {"accelerometer + 500 on z", [](ImuSample& s) { s.accel.z() += 500.0; }},
      {"accelerometer + 50 on x", [](ImuSample& s) { s.accel.x() += 50.0; }},
      {"gyroscope - 5 on y", [](ImuSample& s) { s.gyro.y() -= 5.0; }},
      {"gyroscope + 30", [](ImuSample& s) { s.gyro.array() += 30.0; }},
      {"all zero",
       [](ImuSample& s) {
         s = {s.time, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
       }},
      {"accelerometer zero on z", [](ImuSample& s) { s.accel.z() = 0.0; }},
      {"beyond any", [](ImuSample& s) { s.accel.y() = 1e160; }},
  };
}

TEST(ImuOutliers, BurstsAreLeftOutAndCounted) {
  for (const double rate : {100.0, 200.0, 500.0}) {
    for (const int length : {1, 2, 3, static_cast<int>(0.08 * rate), static_cast<int>(rate)}) {
      for (const Burst& burst : bursts()) {
        if (length == rate && (burst.name == "gyroscope - 5 on y")) {
          continue;  // a turn, if an odd one
        }
        std::size_t spoiled = 0;
        ImuBuffer buffer = fill(rate, [&](double time, ImuSample& sample) {
          if (time > 1.5 && spoiled < static_cast<std::size_t>(length)) {
            burst.spoil(sample);
            ++spoiled;
          }
        });
        EXPECT_EQ(buffer.stats().implausible, spoiled) << burst.name << ", " << rate << " Hz";
        std::vector<ImuSample> found;
        buffer.between(0.0, 3.0, 0.05, found);
        for (const ImuSample& sample : found) {
          EXPECT_NEAR(sample.accel.norm(), 10.0, 3.0) << burst.name << " at " << sample.time;
        }
      }
    }
  }
}

TEST(ImuOutliers, ReadingsThatStandStillWhileTheBodyTurnsAreLeftOut) {
  ImuSample last;
  const ImuBuffer buffer = fill(200.0, [&](double time, ImuSample& sample) {
    if (time > 1.5 && time < 1.999) {
      sample = {time, last.gyro, last.accel};
    }
    last = sample;
  });
  EXPECT_NEAR(static_cast<double>(buffer.stats().implausible), 90.0, 2.0);
  EXPECT_NEAR(buffer.stats().longest_outage, 0.45, 0.02);
  EXPECT_NEAR(buffer.stats().outage_begin, 1.55, 0.02);
}

TEST(ImuOutliers, HardMotionIsNone) {
  const auto pulse = [](double time, double begin, double duration) {
    const double share = (time - begin) / duration;
    return share > 0.0 && share < 1.0 ? std::sin(M_PI * share) : 0.0;
  };
  for (const double rate : {50.0, 100.0, 200.0, 400.0, 1000.0}) {
    const ImuBuffer buffer = fill(rate, [&](double time, ImuSample& sample) {
      for (const double duration : {0.005, 0.01, 0.02, 0.05}) {  // knocks of 3 g
        sample.accel.x() += 29.4 * pulse(time, 1.0 + 10.0 * duration, duration);
        sample.gyro.y() += 2.5 * pulse(time, 1.0 + 10.0 * duration, duration);
      }
      for (const double begin : {2.0, 2.06}) {  // a kerb, with both axles
        sample.accel.z() +=
            40.0 * pulse(time, begin, 0.03) - 20.0 * pulse(time, begin + 0.03, 0.04);
      }
      sample.gyro.z() += 7.0 * std::sin(12.0 * time);  // 400 degrees per second
    });
    EXPECT_EQ(buffer.stats().implausible, 0U) << rate;
  }
}

TEST(ImuOutliers, QuietAndCoarseSensorsHaveNone) {
  const auto step = [](const Eigen::Vector3d& v, double quantum) {
    return Eigen::Vector3d((v / quantum).array().round() * quantum);
  };
  EXPECT_EQ(
      fill(
          200.0,
          [&](double, ImuSample& s) {
            s = {s.time, step(s.gyro, 0.05), step(s.accel, 0.3)};
          })
          .stats()
          .implausible,
      0U);
  EXPECT_EQ(  // no noise, and motion in steps
      fill(
          200.0,
          [&](double time, ImuSample& s) {
            const double a = time > 1.0 && time < 2.0 ? 1.0 : 0.0;
            s = {time, {0.0, 0.0, a}, {a, 0.0, 9.81}};
          })
          .stats()
          .implausible,
      0U);
}

TEST(ImuOutliers, AJoltThatLastsIsKept) {
  const ImuBuffer buffer = fill(200.0, [](double time, ImuSample& sample) {
    if (time > 1.0 && time < 1.5) {
      sample.accel.x() += 35.0;
    }
  });
  EXPECT_EQ(buffer.stats().implausible, 0U);
}

TEST(ImuOutliers, TheLastReadingsWaitWhileTheyMayBeASpike) {
  ImuBuffer buffer;
  Carried carried;
  std::vector<ImuSample> found;
  for (int i = 0; i <= 42; ++i) {
    ImuSample sample = carried.at(0.005 * i);
    sample.accel.x() += i > 40 ? 60.0 : 0.0;
    buffer.add(sample);
  }
  buffer.between(0.0, 0.212, 0.05, found);
  EXPECT_EQ(found.back().time, 0.212);
  EXPECT_LT(found.back().accel.x(), 5.0);  // as the reading before
  buffer.use_until(0.212);
  buffer.add(carried.at(0.215));
  EXPECT_EQ(buffer.stats().implausible, 2U);
  EXPECT_TRUE(buffer.is_doubtful(0.20, 0.215));
  EXPECT_FALSE(buffer.is_doubtful(0.10, 0.20));
}

}  // namespace
}  // namespace nvm::lio
