// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/scan_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "io/cloud/pcd.hpp"
#include "io/file/natural_order.hpp"
#include "io/scan/scan_converter.hpp"
#include "io/temporary_folder.hpp"
#include "support/real_data.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Points on the x axis at 1, 2, ... m with the given times in a field.
PointRecords timed_records(
    const std::string& field, ScalarType type, const std::vector<double>& times) {
  PointRecords records;
  for (const char* name : {"x", "y", "z"}) {
    records.add_field(name, ScalarType::kFloat32);
  }
  records.add_field(field, type);
  records.size = times.size();
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (const float coordinate : {static_cast<float>(i + 1), 0.0F, 0.0F}) {
      append_bytes(coordinate, records.bytes);
    }
    visit_type(type, [&](auto zero) {
      append_bytes(static_cast<decltype(zero)>(times[i]), records.bytes);
    });
  }
  return records;
}

struct TimeCase {
  const char* field;
  ScalarType type;
  std::vector<double> ticks;
  double stamp;
  double t_begin;
};

TEST(ScanConverter, FindsUnitAndOriginOfPointTimes) {
  const std::vector<TimeCase> cases = {
      {"time", ScalarType::kFloat32, {0.0, 0.05, 0.1}, 5.0, 5.0},
      {"time", ScalarType::kFloat32, {-0.1, -0.05, 0.0}, 5.0, 4.9},
      {"time", ScalarType::kFloat64, {5.0, 5.05, 5.1}, 5.0, 5.0},
      {"timestamp", ScalarType::kFloat64, {1.7e9, 1.7e9 + 0.05, 1.7e9 + 0.1}, 1.7e9 + 0.1, 1.7e9},
      {"timestamp", ScalarType::kFloat64, {1.7e18, 1.7e18 + 5e7, 1.7e18 + 1e8}, 0.0, 1.7e9},
      {"t", ScalarType::kUint32, {0, 5e7, 1e8}, 1.7e9, 1.7e9},
      {"offset_time", ScalarType::kUint32, {0, 5e4, 1e5}, 1.7e9, 1.7e9},
      {"time_stamp", ScalarType::kUint16, {0, 50, 100}, 1.0, 1.0},
      {"t", ScalarType::kUint32, {1.8e9, 1.80005e9, 1.8001e9}, 7.0, 7.0},  // us of the hour
  };
  for (const TimeCase& test : cases) {
    const PointRecords records = timed_records(test.field, test.type, test.ticks);
    const Scan scan = ScanConverter().convert(records, test.stamp);
    ASSERT_EQ(scan.points.size(), 3U) << test.field;
    EXPECT_NEAR(scan.t_begin, test.t_begin, 1e-6) << test.field << test.ticks[1];
    EXPECT_NEAR(scan.t_end, test.t_begin + 0.1, 1e-6) << test.field << test.ticks[1];
    EXPECT_NEAR(scan.points[1].dt, 0.05, 1e-6) << test.field << test.ticks[1];
  }
}

TEST(ScanConverter, KeepsTheUnitOfTheFirstScanUnlessTold) {
  ScanConverter automatic;
  automatic.convert(timed_records("t", ScalarType::kUint32, {0, 100000}), 0.0);
  const PointRecords brief = timed_records("t", ScalarType::kUint32, {0, 100});
  EXPECT_FLOAT_EQ(automatic.convert(brief, 0.0).points[1].dt, 1e-4F);
  PointTimeOptions told;
  told.unit = TimeUnit::kNanosecond;
  EXPECT_FLOAT_EQ(ScanConverter(told).convert(brief, 0.0).points[1].dt, 1e-7F);
}

TEST(ScanConverter, SortsByTimeAndKeepsTheOrderOfTies) {
  auto rng = test::rng();
  std::vector<double> times;
  for (int i = 0; i < 1000; ++i) {
    times.push_back(static_cast<double>(rng() % 100) / 1000.0);
  }
  const auto scan = ScanConverter().convert(timed_records("t", ScalarType::kFloat32, times), 0.0);
  for (std::size_t i = 1; i < scan.points.size(); ++i) {
    const auto& a = scan.points[i - 1];
    const auto& b = scan.points[i];
    EXPECT_TRUE(a.dt < b.dt || (a.dt == b.dt && a.x < b.x));
  }
}

TEST(ScanConverter, LeavesOutPointsThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PointRecords records = timed_records("t", ScalarType::kFloat64, {0.0, nan, 0.1, 0.2});
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(&records.bytes[2 * records.record_size + 4], &infinity, sizeof(infinity));
  const Scan scan = ScanConverter().convert(records, 0.0);
  ASSERT_EQ(scan.points.size(), 2U);
  EXPECT_EQ(scan.points[1].x, 4.0F);
  EXPECT_EQ(ScanConverter().convert(timed_records("t", ScalarType::kInt8, {}), 3.0).t_end, 3.0);
}

TEST(ScanConverter, ReadsRingAndIntensityAndWantsCoordinates) {
  PointRecords records;
  records.source = "topic";
  records.add_field("y", ScalarType::kFloat64);
  records.add_field("line", ScalarType::kUint8);
  EXPECT_THAT(
      runtime_error_of([&] { ScanConverter().convert(records, 0.0); }),
      HasSubstr("topic: has no field 'x'"));
  records.add_field("x", ScalarType::kFloat32, 2);
  records.add_field("z", ScalarType::kInt16);
  records.add_field("reflectivity", ScalarType::kUint8);
  records.size = 1;
  append_bytes(2.0, records.bytes);
  append_bytes(std::uint8_t{31}, records.bytes);
  append_bytes(1.0F, records.bytes);
  append_bytes(9.0F, records.bytes);
  append_bytes(std::int16_t{-3}, records.bytes);
  append_bytes(std::uint8_t{200}, records.bytes);
  const Scan scan = ScanConverter().convert(records, 1.5);
  EXPECT_EQ(scan.t_begin, 1.5);
  EXPECT_EQ(scan.t_end, 1.5);
  const TimedPoint& point = scan.points.at(0);
  EXPECT_THAT(
      (std::vector<float>{point.x, point.y, point.z, point.intensity}),
      ElementsAre(1.0F, 2.0F, -3.0F, 200.0F));
  EXPECT_EQ(point.ring, 31);
}

TEST(NaturalOrder, IsByValueAndStrict) {
  std::vector<std::string> names = {"10", "9", "a10b", "a9b", "010", "1.5", "1.25", "b", "a", ""};
  std::sort(names.begin(), names.end(), precedes_naturally);
  EXPECT_THAT(names, ElementsAre("", "1.5", "1.25", "9", "010", "10", "a", "a9b", "a10b", "b"));
  for (const std::string& a : names) {
    for (const std::string& b : names) {
      EXPECT_EQ(precedes_naturally(a, b) || precedes_naturally(b, a), a != b);
    }
  }
}

class ScanFolder : public test::TemporaryFolder {
 protected:
  void write_scans(const std::vector<std::string>& names) const {
    const std::string one_point(16, '?');
    for (const std::string& name : names) {
      write(name, one_point);
    }
  }

  std::vector<double> times() const {
    std::vector<double> times;
    const auto reader = open_sequence(path(""));
    EXPECT_TRUE(reader->imu_until(1e12).empty());
    while (const auto scan = reader->next_scan()) {
      EXPECT_EQ(scan->points.size(), 1U);
      times.push_back(scan->t_begin);
    }
    EXPECT_EQ(times.size(), reader->info().scan_count);
    return times;
  }

  std::string error() const {
    return runtime_error_of([&] { times(); });
  }
};

TEST_F(ScanFolder, AssumesARateWithoutTimes) {
  write_scans({"2.bin", "10.bin", "1.bin", "notes.md"});
  EXPECT_THAT(times(), ElementsAre(0.0, 0.1, 0.2));
  SequenceOptions options;
  options.scan_rate = 0.5;
  const auto reader = open_sequence(path(""), options);
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("0.5 Hz is assumed")));
  EXPECT_EQ(reader->info().format, "folder of .bin scans");
  EXPECT_FALSE(reader->info().has_point_times);
  EXPECT_FALSE(reader->info().has_imu);
  reader->next_scan();
  EXPECT_EQ(reader->next_scan()->t_begin, 2.0);
  options.scan_rate = 0.0;
  EXPECT_THROW(open_sequence(path(""), options), std::invalid_argument);
}

TEST_F(ScanFolder, TakesTimesFromListInSubfolderOrAbove) {
  write_scans({"scans/a.bin", "scans/b.bin", "scans/c.bin"});
  write("timestamps.txt", "# file t[s]\nb.bin 1.5\nscans/a.bin 2e0\n");
  EXPECT_THAT(times(), ElementsAre(1.5, 2.0));
  const auto reader = open_sequence(path(""));
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("1 scans without a time")));
}

TEST_F(ScanFolder, TakesTimesFromKitti) {
  write_scans({"velodyne/000000.bin", "velodyne/000001.bin"});
  write("times.txt", "0.000000e+00\n1.037875e-01\n");
  EXPECT_THAT(times(), ElementsAre(0.0, 0.1037875));
}

TEST_F(ScanFolder, TakesTimesFromNames) {
  write_scans({"1690309709.285306.bin", "1690309709.385.bin"});
  EXPECT_THAT(times(), ElementsAre(1690309709.285306, 1690309709.385));
}

TEST_F(ScanFolder, TakesNanosecondsFromNames) {
  write_scans({"1690309709285306000.bin", "1690309709385000000.bin"});
  const auto found = times();
  EXPECT_NEAR(found.at(0), 1690309709.285306, 1e-6);
  EXPECT_NEAR(found.at(1), 1690309709.385, 1e-6);
}

TEST_F(ScanFolder, BadTimesAreNamed) {
  EXPECT_THAT(error(), HasSubstr("has no .pcd, .ply or .bin scans"));
  write_scans({"a.bin", "b.bin"});
  write("timestamps.txt", "a.bin 1\nb.bin 1\n");
  EXPECT_THAT(error(), HasSubstr("timestamps.txt:2: the time is not above"));
  write("timestamps.txt", "a.bin 1\nc.bin 2\n");
  EXPECT_THAT(error(), HasSubstr("timestamps.txt:2: there is no scan 'c.bin'"));
  write("timestamps.txt", "a.bin 1 2\n");
  EXPECT_THAT(error(), HasSubstr("timestamps.txt:1: is not of the form"));
  write("timestamps.txt", "a.bin nan\n");
  EXPECT_THAT(error(), HasSubstr("'nan' is not a finite number"));
  write("timestamps.txt", "");
  EXPECT_THAT(error(), HasSubstr("lists no scan"));
  std::filesystem::remove(path("timestamps.txt"));
  write("times.txt", "1\n2\n3\n");
  EXPECT_THAT(error(), HasSubstr("has 3 times for 2 scans"));
}

TEST_F(ScanFolder, BadScansAreLeftOutAndNamed) {
  write_scans({"a.bin", "b.bin", "c.bin"});
  write("b.bin", "odd");
  const auto reader = open_sequence(path(""));
  EXPECT_TRUE(reader->next_scan());
  EXPECT_NEAR(reader->next_scan()->t_begin, 0.2, 1e-12);
  EXPECT_FALSE(reader->next_scan());
  EXPECT_EQ(reader->info().skipped_scans, 1U);
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("1 scans are left out; the first: ")));
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("b.bin: 3 bytes")));
}

TEST_F(ScanFolder, OneWithoutAGoodScanIsAnError) {
  write("a.bin", "odd");
  write("b.bin", "odd too");
  const auto reader = open_sequence(path(""));
  EXPECT_THAT(
      runtime_error_of([&] { reader->next_scan(); }),
      AllOf(HasSubstr("no scan can be read"), HasSubstr("a.bin: 3 bytes")));
}

TEST_F(ScanFolder, ScansThatGoBackAreLeftOut) {
  const std::vector<double> late = {1.7e9 + 1.0, 1.7e9 + 1.1};
  const std::vector<double> early = {1.7e9, 1.7e9 + 0.1};
  write_pcd(path("1.pcd"), timed_records("timestamp", ScalarType::kFloat64, late));
  write_pcd(path("2.pcd"), timed_records("timestamp", ScalarType::kFloat64, early));
  const auto reader = open_sequence(path(""));
  EXPECT_TRUE(reader->info().has_point_times);
  EXPECT_EQ(reader->next_scan()->t_begin, late[0]);
  EXPECT_FALSE(reader->next_scan());
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("2.pcd: begins no later than")));
}

TEST(RealScans, AllAreRead) {
  const std::string data = test::real_data();
  if (data.empty()) {
    GTEST_SKIP() << "no real data: set NVM_DATA";
  }
  for (const auto& [folder, scan_count, duration] :
       std::vector<std::tuple<std::string, std::size_t, double>>{
           {"hilti_uzh_run2", 111, 0.0},
           {"norlab_stationary", 14, 0.1},
           {"single_scans", 6, 0.0}}) {
    const auto reader = open_sequence(data + "/" + folder);
    std::size_t scans = 0;
    while (const auto scan = reader->next_scan()) {
      EXPECT_GT(scan->points.size(), 10000U) << folder;
      if (duration > 0.0) {
        EXPECT_NEAR(scan->t_end - scan->t_begin, duration, 0.01) << folder;
      }
      ++scans;
    }
    EXPECT_EQ(scans, scan_count) << folder;
  }
}

}  // namespace
}  // namespace nvm::io
