// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "io/damage.hpp"
#include "io/file.hpp"
#include "io/nvm_sequence_writer.hpp"
#include "io/sequence_reader.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kMeta[] = R"({
  "format": "nvm sequence", "version": 1, "more": {"of": ["anything"]},
  "T_imu_lidar": {"translation": [0.1, -2e-1, 3], "quaternion_xyzw": [0, 0, 1, 0]},
  "counts": {"scans": 3, "points": 12}
})";

lio::Scan some_scan(double t_begin) {
  lio::Scan scan{t_begin, t_begin + 0.1, {}};
  for (int i = 0; i < 4; ++i) {
    const float value = static_cast<float>(i);
    scan.points.push_back(
        {1.0F + value, -value, 0.5F, 10.0F * value, 0.03F * value, static_cast<std::uint16_t>(i)});
  }
  return scan;
}

std::vector<lio::ImuSample> some_imu() {
  std::vector<lio::ImuSample> samples;
  for (int i = 0; i < 250; ++i) {
    samples.push_back({10.0 + 0.005 * i, {0.1, -0.2, 1e-9 * i}, {0.0, 0.0, 9.81}});
  }
  return samples;
}

class NvmSequence : public test::TemporaryFolder {
 protected:
  /// Writes a sequence of three scans of four points, at 10.0, 10.1 and 10.2 s.
  void SetUp() override {
    TemporaryFolder::SetUp();
    NvmSequenceWriter writer(path("s"));
    for (const double time : {10.0, 10.1, 10.2}) {
      writer.add_scan(some_scan(time));
    }
    const auto imu = some_imu();
    writer.write_imu({imu.begin(), imu.begin() + 100});
    writer.write_imu({imu.begin() + 100, imu.end()});
    writer.write_groundtruth({{10.0, Pose::Identity()}});
    writer.write_text("meta.json", kMeta);
    writer.commit();
  }

  /// Reads everything and gives the notes.
  std::vector<std::string> read() const {
    const auto reader = open_sequence(path("s"));
    while (const auto scan = reader->next_scan()) {
      reader->imu_until(scan->t_end);
    }
    reader->imu_until(1e9);
    return reader->info().notes;
  }

  std::string error() const {
    return runtime_error_of([&] { read(); });
  }

  /// Replaces the first `from` in a file of the sequence.
  void edit(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = read_file(path("s/" + name));
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    write("s/" + name, text.replace(at, from.size(), to));
  }

  /// Overwrites one float of a record of the second scan.
  void poke(std::size_t point, std::size_t float_index, float value) const {
    std::string bytes = read_file(path("s/scans/000001.bin"));
    std::memcpy(&bytes[24 * point + 4 * float_index], &value, sizeof(value));
    write("s/scans/000001.bin", bytes);
  }
};

TEST_F(NvmSequence, ReadsBackWhatWasWritten) {
  const auto reader = open_sequence(path("s"));
  const SequenceInfo& info = reader->info();
  EXPECT_EQ(info.format, "nvm sequence");
  EXPECT_EQ(info.scan_count, 3U);
  EXPECT_TRUE(info.has_imu);
  EXPECT_TRUE(info.has_point_times);
  EXPECT_EQ(info.T_imu_lidar.translation(), Eigen::Vector3d(0.1, -0.2, 3.0));
  EXPECT_TRUE(info.T_imu_lidar.linear().isApprox(so3_exp({0, 0, 3.14159265358979323846}), 1e-12));
  for (const double time : {10.0, 10.1, 10.2}) {
    const lio::Scan expected = some_scan(time);
    const auto scan = reader->next_scan();
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->t_begin, time);
    EXPECT_NEAR(scan->t_end, time + 0.1, 1e-9);
    ASSERT_EQ(scan->points.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(scan->points[i].x, expected.points[i].x);
      EXPECT_EQ(scan->points[i].intensity, expected.points[i].intensity);
      EXPECT_EQ(scan->points[i].dt, expected.points[i].dt);
      EXPECT_EQ(scan->points[i].ring, expected.points[i].ring);
    }
  }
  EXPECT_FALSE(reader->next_scan());
  EXPECT_EQ(reader->imu_until(9.9).size(), 0U);
  EXPECT_EQ(reader->imu_until(10.0).size(), 1U);
  const auto rest = reader->imu_until(1e9);
  ASSERT_EQ(rest.size(), 249U);
  EXPECT_EQ(rest[0].time, 10.005);
  EXPECT_EQ(rest[0].gyro, Eigen::Vector3d(0.1, -0.2, 1e-9));
  EXPECT_EQ(rest[0].accel, Eigen::Vector3d(0.0, 0.0, 9.81));
  EXPECT_THAT(info.notes, IsEmpty());
}

TEST_F(NvmSequence, ToleratesUsualWritings) {
  edit("scans.csv", "index,t_begin,t_end,file\n", "file, t_begin, index, t_end, points\r\n");
  edit(
      "scans.csv",
      "0,10.000000000,10.100000000,scans/000000.bin",
      "scans/000000.bin,1e1,0,+10.1,4");
  edit(
      "scans.csv",
      "1,10.100000000,10.200000000,scans/000001.bin",
      "scans/000001.bin,10.1,1,10.2,4");
  edit(
      "scans.csv",
      "2,10.200000000,10.300000000,scans/000002.bin",
      "scans/000002.bin,10.2,2,10.3,4");
  edit("imu.csv", "t,gx,gy,gz,ax,ay,az\n", "");
  EXPECT_THAT(read(), IsEmpty());
}

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

TEST_F(NvmSequence, WriterLeavesNothingHalfAndReplacesNothing) {
  EXPECT_THAT(
      runtime_error_of([&] { NvmSequenceWriter writer(path("s")); }), HasSubstr("exists already"));
  {
    NvmSequenceWriter writer(path("half"));
    writer.add_scan(some_scan(0.0));
    EXPECT_FALSE(std::filesystem::exists(path("half")));
  }
  const std::filesystem::directory_iterator files(path(""));
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  EXPECT_THROW(NvmSequenceWriter(path("s/meta.json/below")), std::runtime_error);
}

}  // namespace
}  // namespace nvm::io
