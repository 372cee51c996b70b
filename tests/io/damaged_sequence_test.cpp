// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/damage.hpp"
#include "io/file/file.hpp"
#include "io/nvm_sequence_fixture.hpp"
#include "io/sequence/nvm_sequence_writer.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(NvmSequence, BadScanFilesAreLeftOutAndNamed) {
  const std::string whole = read_file(path("s/scans/000001.bin"));
  write("s/scans/000001.bin", whole.substr(0, 50));
  EXPECT_THAT(
      read(),
      ElementsAre(
          HasSubstr("meta.json: \"counts\" differs from the 3 scans with 8 points"),
          AllOf(
              HasSubstr("1 scans are left out; the first: "),
              HasSubstr("s/scans/000001.bin: 50 bytes are no whole number"))));
  write("s/scans/000001.bin", whole.substr(0, 48));
  EXPECT_THAT(read(), ElementsAre(HasSubstr("the 3 scans with 10 points")));
  std::filesystem::remove(path("s/scans/000001.bin"));
  EXPECT_THAT(read(), Contains(HasSubstr("s/scans/000001.bin: cannot be read")));
  std::filesystem::remove(path("s/scans/000000.bin"));
  std::filesystem::remove(path("s/scans/000002.bin"));
  EXPECT_THAT(error(), HasSubstr("no scan can be read: 3 scans are left out"));
}

TEST_F(NvmSequence, OtherCountsAreANote) {
  edit("meta.json", "12", "13");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("3 scans with 12 points")));
}

TEST_F(NvmSequence, ScansWithBadTimesAreLeftOutAndPointsThatAreNoneDropped) {
  poke(2, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(read(), IsEmpty());
  const auto reader = open_sequence(path("s"));
  reader->next_scan();
  EXPECT_EQ(reader->next_scan()->points.size(), 3U);
  poke(3, 4, 0.01F);
  EXPECT_THAT(
      read(), ElementsAre(HasSubstr("000001.bin: point 3: dt is below that of the point before")));
  poke(3, 4, std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(read(), ElementsAre(HasSubstr("000001.bin: point 3: dt is below")));
  poke(3, 4, 0.2F);
  EXPECT_THAT(read(), ElementsAre(HasSubstr("000001.bin: point 3: dt is after the scan's t_end")));
  poke(3, 4, 0.1F);
  poke(0, 4, -0.01F);
  EXPECT_THAT(read(), ElementsAre(HasSubstr("000001.bin: point 0: dt is below")));
}

TEST_F(NvmSequence, RecordsOfAnotherLayoutAreLeftOut) {
  std::string bytes;
  for (int i = 0; i < 24 * 4; ++i) {  // float64 x y z, which is 24 bytes too
    const double value = 5.0 * std::sin(i);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  write("s/scans/000001.bin", bytes);
  edit("meta.json", "counts", "other");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("000001.bin: point ")));
}

TEST_F(NvmSequence, BadRowsOfScansAreLeftOutAndNamed) {
  edit("scans.csv", "2,10.200000000", "2,10.100000000");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("000002.bin: begins when the scan before it does")));
  edit("scans.csv", "2,10.100000000", "2,nan");
  EXPECT_THAT(read(), Contains(HasSubstr("scans.csv:4: 'nan' is not a finite number")));
  edit("scans.csv", "2,nan,", "2,");
  EXPECT_THAT(
      read(),
      ElementsAre(
          HasSubstr("1 rows of scans.csv are left out; the first: "),
          HasSubstr("differs from the 2 scans")));
  edit("scans.csv", "t_end", "end");
  EXPECT_THAT(error(), HasSubstr("scans.csv:1: has no column 't_end'"));
  write("s/scans.csv", "");
  EXPECT_THAT(error(), HasSubstr("scans.csv: is empty"));
}

// Twice as long, of the next scan, a duration, missing: the points have times.
TEST_F(NvmSequence, EndsOfScansThatContradictTheirPointsAreMended) {
  for (const auto& [first, second, count] :
       {std::tuple("10.2", "10.3", "2"),
        {"10.3", "10.4", "2"},
        {"0.1", "0.1", "2"},
        {"0", "10.2", "1"},
        {"10.05", "10.2", "1"}}) {
    write(
        "s/scans.csv",
        std::string("index,t_begin,t_end,file\n0,10.0,") + first + ",scans/000000.bin\n1,10.1," +
            second + ",scans/000001.bin\n2,10.2,10.3,scans/000002.bin\n");
    EXPECT_THAT(
        read(),
        ElementsAre(HasSubstr(std::string("the t_end of ") + count + " scans contradicts")));
    const auto reader = open_sequence(path("s"));
    for (const double time : {10.0, 10.1, 10.2}) {
      const auto scan = reader->next_scan();
      EXPECT_EQ(scan->t_begin, time);
      EXPECT_NEAR(scan->t_end, time + 0.095, 0.0051) << first;
    }
  }
}

TEST_F(NvmSequence, ScansAreReadInOrderOfTime) {
  write(
      "s/scans.csv",
      "index,t_begin,t_end,file\n2,10.2,10.3,scans/000002.bin\n0,10.0,10.1,scans/000000.bin\n"
      "1,10.1,10.2,scans/000001.bin\n");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("not in order of time")));
  const auto reader = open_sequence(path("s"));
  for (const double time : {10.0, 10.1, 10.2}) {
    EXPECT_EQ(reader->next_scan()->t_begin, time);
  }
}

TEST_F(NvmSequence, TimesInAnotherUnitAreFoundByTheirSteps) {
  for (const auto& [factor, name] :
       {std::pair(1e3, "milliseconds"), {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
    std::string imu = "t,gx,gy,gz,ax,ay,az\n";
    for (int i = 0; i < 100; ++i) {
      imu += std::to_string(factor * (10.0 + 0.005 * i)) + ",0,0,0,0,0,9.81\n";
    }
    write("s/imu.csv", imu);
    std::string scans = "index,t_begin,t_end,file\n";
    for (int i = 0; i < 3; ++i) {
      scans += std::to_string(i) + "," + std::to_string(factor * (10.0 + 0.1 * i)) + "," +
               std::to_string(factor * (10.1 + 0.1 * i)) + ",scans/00000" + std::to_string(i) +
               ".bin\n";
    }
    write("s/scans.csv", scans);
    EXPECT_THAT(
        read(),
        ElementsAre(
            HasSubstr(std::string("the times of scans.csv are taken for ") + name),
            HasSubstr(std::string("the times of imu.csv are taken for ") + name)));
    const auto reader = open_sequence(path("s"));
    EXPECT_NEAR(reader->next_scan()->t_end, 10.1, 1e-9);
    EXPECT_NEAR(reader->imu_until(10.0021).back().time, 10.0, 1e-9);
  }
}

TEST_F(NvmSequence, TimesOfPointsThatMeanNothingAreForgotten) {
  SequenceOptions options;
  options.point_time_field = "none";
  const auto reader = open_sequence(path("s"), options);
  EXPECT_FALSE(reader->info().has_point_times);
  const auto scan = reader->next_scan();
  EXPECT_EQ(scan->t_end, scan->t_begin);
  for (const TimedPoint& point : scan->points) {
    EXPECT_EQ(point.dt, 0.0F);
  }
}

TEST_F(NvmSequence, TablesOfSpreadsheetsAreRead) {
  std::string imu = read_file(path("s/imu.csv"));
  std::replace(imu.begin(), imu.end(), ',', ';');
  write("s/imu.csv", "\xEF\xBB\xBF" + imu);
  EXPECT_THAT(read(), IsEmpty());
}

TEST_F(NvmSequence, AScanThatIsTheOneBeforeAgainIsLeftOut) {
  NvmSequenceWriter writer(path("long"));
  std::size_t repeats = 0;
  for (int i = 0; i < 100; ++i) {
    const bool hangs = i > 50 && i <= 60;
    repeats += hangs ? 1 : 0;
    Scan scan = some_scan(10.0 + 0.1 * i);
    scan.points[0].x += 0.01F * static_cast<float>(hangs ? 50 : i);
    writer.add_scan(scan);
  }
  writer.write_text("meta.json", "{}");
  writer.commit();
  const auto reader = open_sequence(path("long"));
  std::size_t count = 0;
  while (reader->next_scan()) {
    ++count;
  }
  EXPECT_EQ(count, 100 - repeats);
  EXPECT_THAT(
      reader->info().notes, Contains(HasSubstr("000051.bin: has the points of the scan before")));
}

TEST_F(NvmSequence, ScansOutsideOfTheFolderAreLeftOut) {
  for (const char* file : {"../000002.bin", "scans/../../000002.bin", "/etc/passwd"}) {
    edit("scans.csv", "scans/000002.bin", file);
    EXPECT_THAT(
        read(),
        Contains(AllOf(HasSubstr("scans.csv:4: the file "), HasSubstr("outside of the folder"))))
        << file;
    edit("scans.csv", file, "scans/000002.bin");
  }
}

TEST_F(NvmSequence, ImuGapsAreNotes) {
  auto samples = some_imu();
  samples.erase(samples.begin() + 20, samples.begin() + 60);
  samples.erase(samples.begin() + 180, samples.begin() + 190);
  std::string text = "t,gx,gy,gz,ax,ay,az\n";
  for (const auto& sample : samples) {
    text += std::to_string(sample.time) + ",0,0,0,0,0,9.81\n";
  }
  write("s/imu.csv", text);
  EXPECT_THAT(
      read(),
      ElementsAre(
          "the IMU has 2 gaps of more than 0.020 s, the longest of 0.205 s at t = 10.095 s"));
  std::filesystem::remove(path("s/imu.csv"));
  EXPECT_THAT(read(), ElementsAre(HasSubstr("there is no imu.csv")));
}

TEST_F(NvmSequence, BadMetaIsNamed) {
  edit("meta.json", "[0, 0, 1, 0]", "[0, 0, 0, 0]");
  EXPECT_THAT(error(), HasSubstr("meta.json: quaternion_xyzw does not have length 1"));
  edit("meta.json", "[0, 0, 0, 0]", "[0, 0, 1]");
  EXPECT_THAT(error(), HasSubstr("meta.json: "));
  edit("meta.json", "[0, 0, 1]", "\"up\"");
  EXPECT_THAT(error(), HasSubstr("meta.json: "));
  edit("meta.json", "\"T_imu_lidar\"", "\"T\"");
  EXPECT_FALSE(open_sequence(path("s"))->info().has_T_imu_lidar);
  for (const char* text : {"", "[]", "{", "{\"T_imu_lidar\": 1e999}"}) {
    write("s/meta.json", text);
    EXPECT_THAT(error(), HasSubstr("meta.json: ")) << text;
  }
  std::filesystem::remove(path("s/meta.json"));
  EXPECT_THAT(read(), ElementsAre(HasSubstr("there is no meta.json")));
}

TEST_F(NvmSequence, DamagedFilesNeverDoMoreThanThrow) {
  auto rng = test::rng();
  for (const std::string name : {"meta.json", "scans.csv", "imu.csv", "scans/000001.bin"}) {
    const std::string whole = read_file(path("s/" + name));
    test::read_damaged(
        whole,
        rng,
        [&](const std::string& damaged) {
          write("s/" + name, damaged);
          read();
        },
        300);
    write("s/" + name, whole);
  }
}

}  // namespace
}  // namespace nvm::io
