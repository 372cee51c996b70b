// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "io/cloud/point_records.hpp"
#include "io/file/file.hpp"
#include "io/sequence/nvm_sequence_writer.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ScanForms : public test::TemporaryFolder {
 protected:
  /// `count` points in a corridor, with further numbers behind x, y and z.
  std::string points(std::size_t count, const std::vector<std::vector<float>>& more) const {
    auto rng = test::rng();
    std::uniform_real_distribution<float> along(-20.0F, 20.0F);
    std::uniform_real_distribution<float> up(-0.5F, 2.0F);
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) {
      for (const float value : {along(rng), rng() % 2 == 0 ? 1.5F : -1.2F, up(rng)}) {
        append_bytes(value, bytes);
      }
      for (const auto& column : more) {
        append_bytes(column[i % column.size()], bytes);
      }
    }
    return bytes;
  }

  std::vector<double> times() const {
    std::vector<double> times;
    const auto reader = open_sequence(path(""));
    while (const auto scan = reader->next_scan()) {
      times.push_back(scan->t_begin);
    }
    return times;
  }
};

TEST_F(ScanForms, BinariesOfAnyNumberOfFields) {
  const std::vector<float> intensity = {0.1F, 0.7F, 0.33F, 0.9F, 0.0F};
  const std::vector<float> ring = {0.0F, 7.0F, 31.0F, 12.0F};
  std::vector<float> time;
  for (int i = 0; i < 1200; ++i) {
    time.push_back(static_cast<float>(i) * 1e-4F);
  }
  for (const auto& more : std::vector<std::vector<std::vector<float>>>{
           {}, {intensity}, {intensity, ring}, {intensity, ring, time}, {intensity, time}}) {
    const PointRecords records = read_points(write("a.bin", points(1200, more)));
    EXPECT_EQ(records.fields.size(), 3 + more.size());
    EXPECT_EQ(records.size, 1200U);
    EXPECT_EQ(records.find({"ring"}) != nullptr, more.size() > 1 && more[1] == ring);
    EXPECT_EQ(records.find({"time"}) != nullptr, more.size() > 1 && more.back() == time);
  }
  EXPECT_EQ(read_points(write("b.bin", points(60, {intensity})), 5).size, 48U);
}

TEST_F(ScanForms, OwnScansAreReadAsWhatTheyAre) {
  NvmSequenceWriter writer(path("s"));
  Scan scan{20.0, 20.1, {}};
  for (int i = 0; i < 100; ++i) {
    const float value = static_cast<float>(i);
    scan.points.push_back({value, 2.0F, 1.0F, 5.0F, 0.001F * value, static_cast<std::uint16_t>(i)});
  }
  writer.add_scan(scan);
  writer.write_text("meta.json", "{}");
  writer.commit();
  EXPECT_EQ(open_sequence(path("s/scans"))->info().format, "nvm sequence");
  write("copy/000000.bin", read_file(path("s/scans/000000.bin")));
  const auto read = open_sequence(path("copy"))->next_scan();
  ASSERT_TRUE(read);
  EXPECT_EQ(read->points.size(), 100U);
  EXPECT_NEAR(read->points[50].dt, 0.05, 1e-6);
  EXPECT_EQ(read->points[50].ring, 50);
}

TEST_F(ScanForms, KittiRawFoldersAndDates) {
  for (const int i : {0, 1, 3}) {
    write("velodyne_points/data/000000000" + std::to_string(i) + ".bin", points(30, {{0.5F}}));
  }
  write(
      "velodyne_points/timestamps.txt",
      "2011-09-26 13:02:25.500000000\n2011-09-26 13:02:25.600000000\n"
      "2011-09-26 13:02:25.700000000\n2011-09-26 13:02:25.800000000\n");
  const auto found = times();
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0], 1317042145.5, 1e-6);
  EXPECT_NEAR(found[2], 1317042145.8, 1e-6);
}

TEST_F(ScanForms, NamesOfSecondsAndNanoseconds) {
  write("cloud_1600000000_950000000.bin", points(30, {{0.5F}}));
  write("cloud_1600000001_50000000.bin", points(30, {{0.5F}}));
  const auto found = times();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0], 1600000000.95, 1e-6);
  EXPECT_NEAR(found[1], 1600000001.05, 1e-6);
}

TEST_F(ScanForms, LongCountersAreNoTimes) {
  write("0000000007.bin", points(30, {{0.5F}}));
  write("0000000008.bin", points(30, {{0.5F}}));
  EXPECT_THAT(times(), ElementsAre(0.0, 0.1));
}

TEST_F(ScanForms, AMapAmongTheScansIsLeftOut) {
  for (int i = 0; i < 3; ++i) {
    write("scan" + std::to_string(i) + ".bin", points(30, {{0.5F}}));
  }
  write("finalCloud.bin", points(300, {{0.5F}}));
  const auto reader = open_sequence(path(""));
  EXPECT_EQ(reader->info().scan_count, 3U);
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("left out: finalCloud.bin")));
}

TEST_F(ScanForms, OneFileIsASequence) {
  const auto reader = open_sequence(write("only.bin", points(30, {{0.5F}})));
  EXPECT_EQ(reader->next_scan()->points.size(), 30U);
  EXPECT_FALSE(reader->next_scan());
}

std::string pcd(const std::string& lines, std::size_t count, const std::string& data) {
  return "VERSION 0.7\n" + lines + "WIDTH " + std::to_string(count) + "\nHEIGHT 1\nPOINTS " +
         std::to_string(count) + "\n" + data;
}

TEST_F(ScanForms, PcdOfOtherWriters) {
  std::string data;
  append_bytes(2.5F, data);
  append_bytes(std::uint16_t{77}, data);
  const PointRecords records = read_points(write(
      "count0.pcd",
      pcd("COLUMNS x _ t\nSIZE 4 8 2\nTYPE F F U\nCOUNT 1 0 1\n", 1, "DATA binary\n" + data)));
  EXPECT_EQ(records.record_size, 6U);
  for_each_value(records, *records.find({"t"}), [](auto, double t) { EXPECT_EQ(t, 77.0); });
  const PointRecords text = read_points(write(
      "ascii.pcd",
      pcd("FIELDS x ring t\nSIZE 4 2 4\nTYPE F U U\n", 2, "DATA ascii\n1 3.0 0\n2 4 0.05\n")));
  std::vector<double> ring;
  std::vector<double> t;
  for_each_value(text, *text.find({"ring"}), [&](auto, double value) { ring.push_back(value); });
  for_each_value(text, *text.find({"t"}), [&](auto, double value) { t.push_back(value); });
  EXPECT_THAT(ring, ElementsAre(3.0, 4.0));
  EXPECT_THAT(t, ElementsAre(0.0, 0.05));
}

TEST_F(ScanForms, FilesThatAreCutOffAreReadAsFarAsTheyGo) {
  const std::string head = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  write("a.pcd", pcd(head, 50, "DATA binary\n" + points(40, {}) + "cut"));
  const auto reader = open_sequence(path("a.pcd"));
  EXPECT_EQ(reader->next_scan()->points.size(), 40U);
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("1 files are cut off")));
}

TEST_F(ScanForms, MapCoordinatesGetALocalOrigin) {
  const auto write_shifted = [&](auto zero) {
    using T = decltype(zero);
    std::string bytes;
    for (int i = 0; i < 60; ++i) {
      const double along = 0.1 * i;
      for (const double value : {698765.25 + along, 4512345.5 - along, 431.0}) {
        append_bytes(static_cast<T>(value), bytes);
      }
    }
    const std::string size = std::to_string(sizeof(T));
    write(
        "utm.pcd",
        pcd("FIELDS x y z\nSIZE " + size + " " + size + " " + size + "\nTYPE F F F\n",
            60,
            "DATA binary\n" + bytes));
    return open_sequence(path("utm.pcd"));
  };
  const auto reader = write_shifted(double{});
  const auto origin = reader->info().origin;
  EXPECT_THAT(reader->info().notes, Contains(HasSubstr("local origin")));
  const auto scan = reader->next_scan();
  ASSERT_EQ(scan->points.size(), 60U);
  EXPECT_NEAR(scan->points[7].x + origin[0], 698765.95, 1e-5);
  EXPECT_NEAR(scan->points[7].y + origin[1], 4512344.8, 1e-5);
  EXPECT_EQ(scan->points[7].z + origin[2], 431.0);
  EXPECT_LT(std::abs(scan->points[7].x), 10.0F);
  const auto coarse = write_shifted(float{});
  EXPECT_THAT(
      runtime_error_of([&] { coarse->next_scan(); }), HasSubstr("are float32, which has steps of"));
}

}  // namespace
}  // namespace nvm::io
