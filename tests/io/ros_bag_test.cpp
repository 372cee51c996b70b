// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/file/file.hpp"
#include "io/message/ros_bag_writer.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

#ifndef NVM_WITH_ROSBAG

TEST(RosBag, IsNotBuilt) { GTEST_SKIP() << "built without ROS 1 bags"; }

#else

class RosBag : public test::TemporaryFolder {
 protected:
  static Scan scan_at(double time) {
    Scan scan{time, time + 0.1, {}};
    for (int i = 0; i <= 10; ++i) {
      const float value = static_cast<float>(i);
      const auto ring = static_cast<std::uint16_t>(i % 4);
      scan.points.push_back({value, -1.5F * value, 1e3F, 20.0F * value, 0.01F * value, ring});
    }
    return scan;
  }

  static ImuSample imu_at(double time, double g = 9.81) {
    return {time, {0.1, std::sin(time), -0.3}, {0.0, 0.01 * g, g}};
  }

  /// Ten scans from 1000 s on, and IMU samples at 200 Hz until `imu_end`.
  std::string write_bag(CloudMessageType type, double imu_end = 1001.0, double g = 9.81) const {
    RosBagWriter bag(path("a.bag"), type);
    for (int i = 0; i < 10; ++i) {
      bag.add_scan(scan_at(1000.0 + 0.1 * i));
    }
    for (double time = 1000.0; time < imu_end; time += 0.005) {
      bag.add_imu(imu_at(time, g));
    }
    bag.commit();
    return path("a.bag");
  }

  static std::size_t read_all(const std::string& file) {
    const auto reader = open_sequence(file);
    std::size_t scans = 0;
    while (const auto scan = reader->next_scan()) {
      reader->imu_until(scan->t_end);
      ++scans;
    }
    return scans;
  }
};

TEST_F(RosBag, ReadsBackAllTypesOfMessages) {
  for (const CloudMessageType type :
       {CloudMessageType::kPointCloud2,
        CloudMessageType::kLivoxCustom,
        CloudMessageType::kLivox2Custom}) {
    const auto reader = open_sequence(write_bag(type));
    EXPECT_EQ(reader->info().format, "ROS 1 bag");
    EXPECT_EQ(reader->info().scan_count, 10U);
    EXPECT_TRUE(reader->info().has_imu);
    EXPECT_TRUE(reader->info().has_point_times);
    double imu_time = 999.995;
    for (int i = 0; i < 10; ++i) {
      const Scan expected = scan_at(1000.0 + 0.1 * i);
      const auto scan = reader->next_scan();
      ASSERT_TRUE(scan);
      EXPECT_NEAR(scan->t_begin, expected.t_begin, 1e-6);
      EXPECT_NEAR(scan->t_end, expected.t_end, 1e-6);
      ASSERT_EQ(scan->points.size(), expected.points.size());
      for (std::size_t k = 0; k < expected.points.size(); ++k) {
        EXPECT_EQ(scan->points[k].y, expected.points[k].y);
        EXPECT_EQ(scan->points[k].intensity, expected.points[k].intensity);
        EXPECT_NEAR(scan->points[k].dt, expected.points[k].dt, 1e-8);
        EXPECT_EQ(scan->points[k].ring, expected.points[k].ring);
      }
      for (const ImuSample& sample : reader->imu_until(scan->t_end)) {
        EXPECT_LE(sample.time, scan->t_end);
        EXPECT_NEAR(sample.time, imu_time += 0.005, 1e-6);
        EXPECT_NEAR(sample.gyro.y(), std::sin(sample.time), 1e-6);
        EXPECT_EQ(sample.accel.z(), 9.81);
      }
    }
    EXPECT_GT(imu_time, 1000.98);
    EXPECT_FALSE(reader->next_scan());
  }
}

TEST_F(RosBag, FindsAccelerationsInG) {
  const std::string file = write_bag(CloudMessageType::kPointCloud2, 1001.0, 1.0);
  const auto reader = open_sequence(file);
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("measures in g")));
  EXPECT_NEAR(reader->imu_until(1000.0).at(0).accel.z(), 9.80665, 1e-12);
  SequenceOptions options;
  options.accel_unit = AccelUnit::kMetrePerSquareSecond;
  EXPECT_EQ(open_sequence(file, options)->imu_until(1000.0).at(0).accel.z(), 1.0);
}

TEST_F(RosBag, TopicsCanBeChosen) {
  const std::string file = write_bag(CloudMessageType::kPointCloud2);
  SequenceOptions options;
  options.lidar_topic = "/lidar";
  EXPECT_TRUE(open_sequence(file, options)->next_scan());
  options.imu_topic = "/imu/raw";
  EXPECT_THAT(
      runtime_error_of([&] { open_sequence(file, options); }),
      HasSubstr("a.bag: has no IMU topic '/imu/raw'; there are: /imu"));
}

TEST_F(RosBag, ImuThatEndsEarlyDoesNotPullAllScansIn) {
  RosBagWriter bag(path("a.bag"), CloudMessageType::kLivoxCustom);
  bag.add_imu(imu_at(1000.0));
  for (int i = 0; i < 200; ++i) {
    bag.add_scan(scan_at(1000.0 + 0.1 * i));
  }
  bag.add_imu(imu_at(1020.0));
  bag.commit();
  const auto reader = open_sequence(path("a.bag"));
  EXPECT_EQ(reader->imu_until(1010.0).size(), 1U);  // and gives up before the end of the bag
  std::size_t scans = 0;
  while (reader->next_scan()) {
    ++scans;
  }
  EXPECT_EQ(scans, 200U);
  EXPECT_EQ(reader->imu_until(1e9).size(), 1U);
}

TEST_F(RosBag, BadImuMessagesAreCountedAndGapsNoted) {
  RosBagWriter bag(path("a.bag"), CloudMessageType::kPointCloud2);
  bag.add_scan(scan_at(1000.0));
  for (int i = 0; i < 200; ++i) {
    bag.add_imu(imu_at(1000.0 + 0.005 * i));
  }
  bag.add_imu(imu_at(1000.995));
  bag.add_imu(imu_at(1001.0, std::nan("")));
  bag.add_imu(imu_at(1001.9));
  bag.commit();
  const auto reader = open_sequence(path("a.bag"));
  EXPECT_EQ(reader->imu_until(1e9).size(), 201U);
  EXPECT_THAT(
      reader->info().notes,
      Contains(HasSubstr("2 IMU messages are left out; the first: /imu at 1000.995")));
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("the IMU has 1 gaps")));
}

TEST_F(RosBag, CloudsThatRepeatOrComeLateAreLeftOut) {
  RosBagWriter bag(path("a.bag"), CloudMessageType::kPointCloud2);
  for (int i = 0; i < 6; ++i) {
    bag.add_scan(scan_at(1000.0 + 0.1 * i));
  }
  Scan late = scan_at(1000.2);
  late.t_end = 1000.55;  // recorded three scans later than it should
  bag.add_scan(late);
  bag.add_scan(scan_at(1000.6));
  bag.commit();
  const auto reader = open_sequence(path("a.bag"));
  std::vector<double> times;
  while (const auto scan = reader->next_scan()) {
    times.push_back(scan->t_begin);
  }
  ASSERT_EQ(times.size(), 7U);
  EXPECT_NEAR(times.back(), 1000.6, 1e-6);
  EXPECT_EQ(reader->info().skipped_scans, 1U);
  EXPECT_THAT(
      reader->info().notes,
      Contains(HasSubstr("1 clouds are left out; the first: /lidar at 1000.550000 s (stamp "
                         "1000.200000 s)")));
}

TEST_F(RosBag, OtherFilesAreNamed) {
  EXPECT_THAT(
      runtime_error_of([&] { open_sequence(write("text.bag", "no bag at all\n")); }),
      HasSubstr("text.bag: "));
  RosBagWriter bag(path("imu.bag"), CloudMessageType::kPointCloud2);
  bag.add_imu(imu_at(1.0));
  bag.commit();
  EXPECT_THAT(
      runtime_error_of([&] { open_sequence(path("imu.bag")); }),
      AllOf(
          HasSubstr("imu.bag: has no topic with PointCloud2 or CustomMsg"),
          HasSubstr("there are: /imu (sensor_msgs/Imu)")));
  EXPECT_THAT(
      runtime_error_of([&] { RosBagWriter(path("no/a.bag"), CloudMessageType::kPointCloud2); }),
      HasSubstr("no/a.bag: "));
}

TEST_F(RosBag, WriterLeavesNothingHalf) {
  { RosBagWriter(path("half.bag"), CloudMessageType::kPointCloud2).add_scan(scan_at(1.0)); }
  EXPECT_TRUE(std::filesystem::is_empty(path("")));
}

TEST_F(RosBag, TruncatedBagsAreReadAsFarAsTheyGo) {
  const std::string whole = read_file(write_bag(CloudMessageType::kLivoxCustom));
  std::size_t most = 0;
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 50) {
    const std::string file = write("cut.bag", whole.substr(0, size));
    try {
      const auto reader = open_sequence(file);
      std::size_t scans = 0;
      while (const auto scan = reader->next_scan()) {
        EXPECT_NEAR(scan->t_begin, 1000.0 + 0.1 * static_cast<double>(scans), 1e-6) << size;
        EXPECT_EQ(scan->points.size(), 11U);
        ++scans;
      }
      EXPECT_GE(scans, most) << size;
      most = std::max(most, scans);
      EXPECT_THAT(reader->info().notes, Contains(HasSubstr("cut.bag: is cut off"))) << size;
      EXPECT_THAT(reader->info().notes, Contains(HasSubstr("rosbag reindex"))) << size;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(most, 0U) << size;
      EXPECT_THAT(error.what(), HasSubstr("cut.bag: ")) << size;
    }
  }
  EXPECT_EQ(most, 10U);
}

TEST_F(RosBag, ChangedBytesCostMessagesOrChangeNumbers) {
  const std::string whole = read_file(write_bag(CloudMessageType::kPointCloud2));
  auto random = test::rng();
  std::size_t noticed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::string changed = whole;
    changed[random() % changed.size()] = static_cast<char>(random());
    try {
      const auto reader = open_sequence(write("changed.bag", changed));
      while (const auto scan = reader->next_scan()) {
        reader->imu_until(scan->t_end);
      }
      noticed += reader->info().skipped_scans + reader->info().skipped_imu_samples;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("changed.bag: "));
      ++noticed;
    }
  }
  EXPECT_GT(noticed, 0U);
}

TEST_F(RosBag, OneThatWasNotClosedIsRead) {
  std::string open = read_file(write_bag(CloudMessageType::kPointCloud2));
  const std::string field = "index_pos=";
  open.replace(open.find(field) + field.size(), 8, std::string(8, '\0'));
  EXPECT_EQ(read_all(write("open.bag", open)), 10U);
}

TEST_F(RosBag, PartsInAFolderAreOneRecording) {
  for (const int part : {10, 9}) {
    std::filesystem::create_directories(path("parts"));
    RosBagWriter bag(
        path("parts/run_" + std::to_string(part) + ".bag"), CloudMessageType::kPointCloud2);
    for (int i = 0; i < 5; ++i) {
      bag.add_scan(scan_at(1000.0 + part + 0.1 * i));
    }
    bag.commit();
  }
  const auto reader = open_sequence(path("parts"));
  EXPECT_EQ(reader->info().scan_count, 10U);
  EXPECT_NEAR(reader->next_scan()->t_begin, 1009.0, 1e-6);
  EXPECT_EQ(read_all(path("parts")), 10U);
}

#endif

}  // namespace
}  // namespace nvm::io
