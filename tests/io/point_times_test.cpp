// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/point_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "io/scan_converter.hpp"
#include "io/temporary_folder.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr int kColumns = 400;
constexpr int kBeams = 4;

/// A sensor that turns once in `period`, anticlockwise from -x, beams side by side. Every second
/// beam sees nothing in every tenth column.
struct Sensor {
  double period = 0.05;
  double start = 100.0;  ///< [s]
  std::string field = "t";
  ScalarType type = ScalarType::kUint32;
  /// The tick of a point at time `dt` of the sweep that begins at `t`.
  std::function<double(double t, double dt)> tick = [](double, double dt) { return 1e9 * dt; };
  std::function<double(double t)> stamp = [](double t) { return t; };
  double delay = 0.001;  ///< of recording, after the sweep's end

  double time_of(int sweep) const { return start + period * sweep; }

  CloudMessage cloud(int sweep) const {
    CloudMessage message;
    PointRecords& records = message.records;
    records.source = "/scan";
    for (const char* name : {"x", "y", "z"}) {
      records.add_field(name, ScalarType::kFloat32);
    }
    records.add_field("ring", ScalarType::kUint8);
    if (!field.empty()) {
      records.add_field(field, type);
    }
    const double t = time_of(sweep);
    for (int column = 0; column < kColumns; ++column) {
      for (int beam = 0; beam < kBeams; ++beam) {
        append_point(t, column, beam, records);
      }
    }
    message.stamp = stamp(t);
    message.record_time = t + period + delay;
    return message;
  }

  void append_point(double t, int column, int beam, PointRecords& records) const {
    const double share = static_cast<double>(column) / kColumns;
    const double azimuth = 2.0 * M_PI * (share - 0.5);
    const bool is_return = column % 10 != 7 || beam % 2 == 0;
    const double range = is_return ? 5.0 + beam : 0.0;
    for (const double value :
         {range * std::cos(azimuth), range * std::sin(azimuth), is_return ? 0.3 * beam : 0.0}) {
      append_bytes(static_cast<float>(value), records.bytes);
    }
    append_bytes(static_cast<std::uint8_t>(beam), records.bytes);
    if (!field.empty()) {
      const double ticks = is_return ? tick(t, period * share) : 0.0;
      visit_type(type, [&](auto zero) {
        using T = decltype(zero);
        if constexpr (std::is_same_v<T, std::uint32_t>) {
          append_bytes(
              static_cast<T>(static_cast<std::int64_t>(std::llround(ticks))), records.bytes);
        } else {
          append_bytes(static_cast<T>(ticks), records.bytes);
        }
      });
    }
    ++records.size;
  }

  std::vector<CloudMessage> clouds(int count) const {
    std::vector<CloudMessage> messages;
    for (int i = 0; i < count; ++i) {
      messages.push_back(cloud(i));
    }
    return messages;
  }

  /// The scans of `count` sweeps; `damage` may change the messages first.
  std::vector<lio::Scan> scans(
      ScanConverter& converter, const std::vector<CloudMessage>& messages) const {
    converter.learn(messages);
    std::vector<lio::Scan> scans;
    for (const CloudMessage& message : messages) {
      scans.push_back(converter.convert(message.records, message.stamp));
    }
    return scans;
  }
};

/// The time in its sweep at which `sensor` measured the point, by its azimuth.
double true_time(const Sensor& sensor, const lio::TimedPoint& point) {
  const double share = std::atan2(point.y, point.x) / (2.0 * M_PI) + 0.5;
  return sensor.period * (share > 1.0 - 0.5 / kColumns ? 0.0 : share);
}

/// Expects all points of the scan, at least `min_count`, to have the time at which they were
/// measured.
void expect_true_times(
    const Sensor& sensor, int sweep, const lio::Scan& scan, std::size_t min_count = 1500) {
  ASSERT_GE(scan.points.size(), min_count);
  const double tolerance = 2e-4 * sensor.period;
  for (const lio::TimedPoint& point : scan.points) {
    const double expected = sensor.time_of(sweep) + true_time(sensor, point);
    ASSERT_NEAR(scan.t_begin + static_cast<double>(point.dt), expected, tolerance + 1e-6) << sweep;
  }
  EXPECT_NEAR(scan.t_end, scan.t_begin + static_cast<double>(scan.points.back().dt), 1e-6);
}

void expect_true_times(const Sensor& sensor, PointTimeOptions options = {}) {
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
  Sensor sensor;
  sensor.start = 1.6e9;
  sensor.type = ScalarType::kFloat64;
  sensor.tick = [](double t, double dt) { return t + dt; };
  expect_true_times(sensor);
}

TEST(PointTimes, UnitsAreFoundAtAnyRate) {
  for (const double period : {0.02, 0.05, 0.1, 0.2}) {
    for (const double ticks_per_second : {1e3, 1e6, 1e9}) {
      Sensor sensor;
      sensor.period = period;
      sensor.type = ScalarType::kFloat64;
      sensor.tick = [&](double, double dt) { return ticks_per_second * dt; };
      expect_true_times(sensor);
    }
  }
}

TEST(PointTimes, SharesPercentagesAndDegreesOfASweep) {
  for (const double whole : {1.0, 100.0, 360.0}) {
    Sensor sensor;
    sensor.type = ScalarType::kFloat32;
    sensor.tick = [&](double, double dt) { return whole * dt / sensor.period; };
    expect_true_times(sensor);
  }
  Sensor slow;  // one sweep a second: shares are seconds
  slow.period = 1.0;
  slow.type = ScalarType::kFloat32;
  slow.tick = [](double, double dt) { return dt; };
  expect_true_times(slow);
}

TEST(PointTimes, ASharedOptionBeatsTheGuess) {
  Sensor sensor;
  sensor.period = 0.7;
  sensor.type = ScalarType::kFloat32;
  sensor.tick = [&](double, double dt) { return dt / sensor.period; };
  PointTimeOptions options;
  options.unit = TimeUnit::kSweep;
  expect_true_times(sensor, options);
}

TEST(PointTimes, NegativeTimesInUnsignedNumbers) {
  Sensor sensor;
  sensor.stamp = [&](double t) { return t + 0.5 * sensor.period; };
  sensor.tick = [&](double, double dt) { return 1e9 * (dt - 0.5 * sensor.period); };
  expect_true_times(sensor);
  sensor.stamp = [&](double t) { return t + sensor.period; };
  sensor.tick = [&](double, double dt) { return 1e9 * (dt - sensor.period); };
  expect_true_times(sensor);
}

TEST(PointTimes, OneScanWhoseCounterWrapped) {
  Sensor sensor;
  auto clouds = sensor.clouds(8);
  for (const std::size_t bad : {0U, 5U}) {
    Sensor early = sensor;
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
  Sensor sensor;
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
    Sensor sensor;
    auto clouds = sensor.clouds(8);
    Sensor absurd = sensor;
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
  Sensor sensor;
  auto clouds = sensor.clouds(8);
  Sensor absurd = sensor;
  absurd.tick = [](double, double dt) { return std::fmod(7e12 * dt, 2e9); };
  clouds[2] = absurd.cloud(2);
  Sensor without = sensor;
  without.field = "";
  clouds[5] = without.cloud(5);
  ScanConverter converter(raw());
  const auto scans = sensor.scans(converter, clouds);
  expect_true_times(sensor, 2, scans[2]);
  expect_true_times(sensor, 5, scans[5]);
  EXPECT_THAT(converter.notes(), Contains(HasSubstr("2 scans have no times, or some that do not")));
}

TEST(PointTimes, AFirstScanThatIsShort) {
  Sensor sensor;
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
  Sensor sensor;
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
  Sensor sensor;
  sensor.field = "";
  ScanConverter converter;
  const auto scans = sensor.scans(converter, sensor.clouds(8));
  EXPECT_EQ(scans[3].t_end, sensor.time_of(3));
  EXPECT_FALSE(converter.has_point_times());
  EXPECT_THAT(converter.notes(), Contains(HasSubstr("set input.point_time_field")));
}

TEST(PointTimes, AFieldOfAnyNameCanBeNamed) {
  Sensor sensor;
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
    Sensor sensor;
    sensor.field = name;
    expect_true_times(sensor);
  }
}

TEST(PointTimes, StampsAtTheSweepsEnd) {
  Sensor sensor;
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
  Sensor sensor;
  for (const double delay : {0.0, 0.01, 0.3, -sensor.period}) {  // the last: by a converter
    sensor.delay = delay;
    expect_true_times(sensor);
  }
}

}  // namespace
}  // namespace nvm::io
