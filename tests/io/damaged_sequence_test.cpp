// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "io/damage.hpp"
#include "io/file/file.hpp"
#include "io/nvm_sequence_fixture.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(NvmSequence, BadScanFilesAreNamed) {
  const std::string whole = read_file(path("s/scans/000001.bin"));
  write("s/scans/000001.bin", whole.substr(0, 50));
  EXPECT_THAT(error(), HasSubstr("s/scans/000001.bin: 50 bytes are no whole number"));
  write("s/scans/000001.bin", whole.substr(0, 48));
  EXPECT_THAT(error(), HasSubstr("meta.json: \"counts\" differs from the 3 scans with 10 points"));
  std::filesystem::remove(path("s/scans/000001.bin"));
  EXPECT_THAT(error(), HasSubstr("s/scans/000001.bin: is missing"));
}

TEST_F(NvmSequence, OtherCountsAreANoteInOthersSequences) {
  edit("meta.json", "nvm sequence", "something else");
  EXPECT_THAT(read(), IsEmpty());
  edit("meta.json", "12", "13");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("3 scans with 12 points")));
}

TEST_F(NvmSequence, BadPointsAreNamed) {
  poke(2, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(error(), HasSubstr("000001.bin: point 2: a coordinate is not a finite number"));
  poke(2, 1, 0.0F);
  EXPECT_THAT(read(), IsEmpty());
  poke(3, 4, 0.01F);
  EXPECT_THAT(error(), HasSubstr("000001.bin: point 3: dt is below that of the point before"));
  poke(3, 4, std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(error(), HasSubstr("000001.bin: point 3: dt is below"));
  poke(3, 4, 0.2F);
  EXPECT_THAT(error(), HasSubstr("000001.bin: point 3: dt is after the scan's t_end"));
  poke(3, 4, 0.1F);
  poke(0, 4, -0.01F);
  EXPECT_THAT(error(), HasSubstr("000001.bin: point 0: dt is below"));
}

TEST_F(NvmSequence, RecordsOfAnotherLayoutAreAnError) {
  std::string bytes;
  for (int i = 0; i < 24 * 4; ++i) {  // float64 x y z, which is 24 bytes too
    const double value = 5.0 * std::sin(i);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  write("s/scans/000001.bin", bytes);
  edit("meta.json", "counts", "other");
  EXPECT_THAT(error(), HasSubstr("000001.bin: point "));
}

TEST_F(NvmSequence, BadScanTimesAreNamed) {
  edit("scans.csv", "2,10.200000000", "2,10.100000000");
  EXPECT_THAT(error(), HasSubstr("scans.csv:4: t_begin is not above that of the scan before"));
  edit("scans.csv", "2,10.100000000", "2,10.050000000");
  EXPECT_THAT(error(), HasSubstr("scans.csv:4: t_begin is not above"));
  edit("scans.csv", "2,10.050000000", "2,10.400000000");
  EXPECT_THAT(error(), HasSubstr("scans.csv:4: t_end is below t_begin"));
  edit("scans.csv", "2,10.400000000", "2,nan");
  EXPECT_THAT(error(), HasSubstr("scans.csv:4: 'nan' is not a finite number"));
  edit("scans.csv", "2,nan,", "2,");
  EXPECT_THAT(error(), HasSubstr("scans.csv:4: has 3 values instead of 4"));
  edit("scans.csv", "t_end", "end");
  EXPECT_THAT(error(), HasSubstr("scans.csv:1: has no column 't_end'"));
  write("s/scans.csv", "");
  EXPECT_THAT(error(), HasSubstr("scans.csv: is empty"));
}

TEST_F(NvmSequence, BadImuRowsAreLeftOutAndCounted) {
  edit("imu.csv", "10.005000000", "10.000000000");
  EXPECT_THAT(
      read(),
      ElementsAre(AllOf(
          HasSubstr("1 rows of imu.csv are left out; the first: "),
          HasSubstr("imu.csv:3: the time is not above that of the sample before"))));
  edit("imu.csv", "\n10.000000000,0.100000000", "\n9.999000000,inf");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("imu.csv:2: 'inf' is not a finite number")));
  edit("imu.csv", "9.999000000,inf", "9.999000000,-1e160");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("imu.csv:2: a reading is absurd")));
  edit("imu.csv", "9.999000000,-1e160", "9.999000000,0.1,0.1");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("imu.csv:2: has 8 values instead of 7")));
}

TEST_F(NvmSequence, ScansOutsideOfTheFolderAreRefused) {
  for (const char* file : {"../000002.bin", "scans/../../000002.bin", "/etc/passwd"}) {
    edit("scans.csv", "scans/000002.bin", file);
    EXPECT_THAT(error(), HasSubstr("scans.csv:4: the file ")) << file;
    EXPECT_THAT(error(), HasSubstr("is outside of the folder")) << file;
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
  EXPECT_THAT(error(), HasSubstr("meta.json: cannot be read"));
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
