// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "io/nvm_sequence_fixture.hpp"
#include "io/sequence/nvm_sequence_writer.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "io/temporary_folder.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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
    const Scan expected = some_scan(time);
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
