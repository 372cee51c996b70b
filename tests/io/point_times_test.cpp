// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/point_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/scan/scan_converter.hpp"
#include "io/temporary_folder.hpp"
#include "io/turning_sensor.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::Contains;
using ::testing::HasSubstr;

/// The time in its sweep at which `sensor` measured the point, by its azimuth.
double true_time(const TurningSensor& sensor, const TimedPoint& point) {
  const double share = std::atan2(point.y, point.x) / (2.0 * M_PI) + 0.5;
  return sensor.period * (share > 1.0 - 0.5 / kColumns ? 0.0 : share);
}

/// Expects all points of the scan, at least `min_count`, to have the time at which they were
/// measured.
void expect_true_times(
    const TurningSensor& sensor, int sweep, const Scan& scan, std::size_t min_count = 1500) {
  ASSERT_GE(scan.points.size(), min_count);
  const double tolerance = 2e-4 * sensor.period;
  for (const TimedPoint& point : scan.points) {
    const double expected = sensor.time_of(sweep) + true_time(sensor, point);
    ASSERT_NEAR(scan.t_begin + static_cast<double>(point.dt), expected, tolerance + 1e-6) << sweep;
  }
  EXPECT_NEAR(scan.t_end, scan.t_begin + static_cast<double>(scan.points.back().dt), 1e-6);
}

void expect_true_times(const TurningSensor& sensor, PointTimeOptions options = {}) {
  ScanConverter converter(std::move(options));
  const auto scans = sensor.scans(converter, sensor.clouds(8));
  for (int i = 0; i < 8; ++i) {
    expect_true_times(sensor, i, scans[static_cast<std::size_t>(i)]);
  }
}

PointTimeOptions raw() {
  PointTimeOptions options;
  options.is_raw = true;
  return options;
}

TEST(PointTimes, NoReturnsHaveNoSayInTheTimes) {
  TurningSensor sensor;
  sensor.start = 1.6e9;
  sensor.type = ScalarType::kFloat64;
  sensor.tick = [](double t, double dt) { return t + dt; };
  expect_true_times(sensor);
}

TEST(PointTimes, UnitsAreFoundAtAnyRate) {
  for (const double period : {0.02, 0.05, 0.1, 0.2}) {
    for (const double ticks_per_second : {1e3, 1e6, 1e9}) {
      TurningSensor sensor;
      sensor.period = period;
      sensor.type = ScalarType::kFloat64;
      sensor.tick = [&](double, double dt) { return ticks_per_second * dt; };
      expect_true_times(sensor);
    }
  }
}

TEST(PointTimes, SharesPercentagesAndDegreesOfASweep) {
  for (const double whole : {1.0, 100.0, 360.0}) {
    TurningSensor sensor;
    sensor.type = ScalarType::kFloat32;
    sensor.tick = [&](double, double dt) { return whole * dt / sensor.period; };
    expect_true_times(sensor);
  }
  TurningSensor slow;  // one sweep a second: shares are seconds
  slow.period = 1.0;
  slow.type = ScalarType::kFloat32;
  slow.tick = [](double, double dt) { return dt; };
  expect_true_times(slow);
}

TEST(PointTimes, ASharedOptionBeatsTheGuess) {
  TurningSensor sensor;
  sensor.period = 0.7;
  sensor.type = ScalarType::kFloat32;
  sensor.tick = [&](double, double dt) { return dt / sensor.period; };
  PointTimeOptions options;
  options.unit = TimeUnit::kSweep;
  expect_true_times(sensor, options);
}

TEST(PointTimes, NegativeTimesInUnsignedNumbers) {
  TurningSensor sensor;
  sensor.stamp = [&](double t) { return t + 0.5 * sensor.period; };
  sensor.tick = [&](double, double dt) { return 1e9 * (dt - 0.5 * sensor.period); };
  expect_true_times(sensor);
  sensor.stamp = [&](double t) { return t + sensor.period; };
  sensor.tick = [&](double, double dt) { return 1e9 * (dt - sensor.period); };
  expect_true_times(sensor);
}

TEST(PointTimes, OneScanWhoseCounterWrapped) {
  TurningSensor sensor;
  auto clouds = sensor.clouds(8);
  for (const std::size_t bad : {0U, 5U}) {
    TurningSensor early = sensor;
    early.stamp = [](double t) { return t + 0.012; };
    early.tick = [](double, double dt) { return 1e9 * (dt - 0.012); };
    clouds[bad] = early.cloud(static_cast<int>(bad));
  }
  ScanConverter converter;
  const auto scans = sensor.scans(converter, clouds);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    expect_true_times(sensor, static_cast<int>(i), scans[i]);
  }
}

TEST(PointTimes, AFreeCounterThatWrapsWithinAScan) {
  TurningSensor sensor;
  sensor.start = 4.2949672 - 0.06;  // [s]: 2^32 ns lie within the second scan
  sensor.tick = [](double t, double dt) { return 1e9 * (t + dt); };
  sensor.stamp = [](double t) { return t + 1000.0; };
  ScanConverter converter;
  const auto scans = sensor.scans(converter, sensor.clouds(8));
  sensor.start += 1000.0;
  for (int i = 0; i < 8; ++i) {
    expect_true_times(sensor, i, scans[static_cast<std::size_t>(i)]);
  }
}

TEST(PointTimes, AbsurdTimesAreLeftOutAndCounted) {
  for (const int bad_sweep : {0, 4}) {
    TurningSensor sensor;
    auto clouds = sensor.clouds(8);
    TurningSensor absurd = sensor;
    absurd.tick = [](double, double dt) { return dt < 0.02 ? 2.9e9 : 1e9 * dt; };
    clouds[static_cast<std::size_t>(bad_sweep)] = absurd.cloud(bad_sweep);
    ScanConverter converter;
    const auto scans = sensor.scans(converter, clouds);
    for (int i = 0; i < 8; ++i) {
      const std::size_t count = i == bad_sweep ? 800 : 1500;
      expect_true_times(sensor, i, scans[static_cast<std::size_t>(i)], count);
    }
    EXPECT_THAT(converter.notes(), Contains(HasSubstr("608 points whose times do not fit")));
  }
}

TEST(PointTimes, AScanOfAbsurdOrWithoutTimesIsDatedByAzimuth) {
  TurningSensor sensor;
  auto clouds = sensor.clouds(8);
  TurningSensor absurd = sensor;
  absurd.tick = [](double, double dt) { return std::fmod(7e12 * dt, 2e9); };
  clouds[2] = absurd.cloud(2);
  TurningSensor without = sensor;
  without.field = "";
  clouds[5] = without.cloud(5);
  ScanConverter converter(raw());
  const auto scans = sensor.scans(converter, clouds);
  expect_true_times(sensor, 2, scans[2]);
  expect_true_times(sensor, 5, scans[5]);
  EXPECT_THAT(converter.notes(), Contains(HasSubstr("2 scans have no times, or some that do not")));
}

TEST(PointTimes, AFirstScanThatIsShort) {
  TurningSensor sensor;
  auto clouds = sensor.clouds(8);
  PointRecords& first = clouds[0].records;
  constexpr std::size_t kLast = 20;  // five columns, and the times count on
  first.bytes = first.bytes.substr((first.size - kLast) * first.record_size);
  first.size = kLast;
  ScanConverter converter;
  const auto scans = sensor.scans(converter, clouds);
  for (int i = 0; i < 8; ++i) {
    expect_true_times(sensor, i, scans[static_cast<std::size_t>(i)], i == 0 ? 15 : 1500);
  }
}

TEST(PointTimes, WithoutTimesTheAzimuthOfRawScansTells) {
  TurningSensor sensor;
  sensor.field = "";
  expect_true_times(sensor, raw());
  sensor.field = "t";
  sensor.tick = [](double, double) { return 17.0; };
  expect_true_times(sensor, raw());
  sensor.type = ScalarType::kFloat32;  // steps of 128 s
  sensor.tick = [](double t, double dt) { return 1.65e9 + t + dt; };
  expect_true_times(sensor, raw());
  PointTimeOptions options;
  options.field = "azimuth";
  expect_true_times(sensor, options);
}

TEST(PointTimes, WithoutTimesAScanIsOneInstantUnlessRaw) {
  TurningSensor sensor;
  sensor.field = "";
  ScanConverter converter;
  const auto scans = sensor.scans(converter, sensor.clouds(8));
  EXPECT_EQ(scans[3].t_end, sensor.time_of(3));
  EXPECT_FALSE(converter.has_point_times());
  EXPECT_THAT(converter.notes(), Contains(HasSubstr("set input.point_time_field")));
}

TEST(PointTimes, AFieldOfAnyNameCanBeNamed) {
  TurningSensor sensor;
  sensor.field = "when";
  PointTimeOptions options;
  options.field = "when";
  expect_true_times(sensor, options);
  options.field = "then";
  EXPECT_THAT(
      runtime_error_of([&] { expect_true_times(sensor, options); }),
      HasSubstr("/scan: has no field 'then' for the times; there are: x, y, z, ring, when"));
}

TEST(PointTimes, CommonNames) {
  for (const char* name : {"time", "time_offset", "ts", "point_time", "stamp", "offset_time"}) {
    TurningSensor sensor;
    sensor.field = name;
    expect_true_times(sensor);
  }
}

TEST(PointTimes, StampsAtTheSweepsEnd) {
  TurningSensor sensor;
  sensor.stamp = [&](double t) { return t + sensor.period; };
  expect_true_times(sensor);  // found: messages are recorded before such a sweep could end
  sensor.field = "";
  expect_true_times(sensor, raw());
  sensor.field = "t";
  sensor.delay = 10.0;  // no recorder tells: the option does
  PointTimeOptions options;
  options.stamp = StampMeaning::kEnd;
  expect_true_times(sensor, options);
}

TEST(PointTimes, StampsAtTheBeginStayThere) {
  TurningSensor sensor;
  for (const double delay : {0.0, 0.01, 0.3, -sensor.period}) {  // the last: by a converter
    sensor.delay = delay;
    expect_true_times(sensor);
  }
}

}  // namespace
}  // namespace nvm::io
