// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "io/cloud/pcd.hpp"
#include "io/cloud/ply.hpp"
#include "io/cloud/point_records.hpp"
#include "io/encoded_records.hpp"
#include "io/file/file.hpp"
#include "io/file/pending_path.hpp"
#include "io/result/map_cloud.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::column;
using test::compressed_pcd;
using test::random_records;
using test::runtime_error_of;
using test::text_of;
using ::testing::HasSubstr;

class PointFiles : public test::TemporaryFolder {};

TEST_F(PointFiles, PcdOfAnyLayoutReadsBackInAllEncodings) {
  auto rng = test::rng();
  for (int i = 0; i < 50; ++i) {
    const PointRecords records = random_records(rng, false);
    write_pcd(path("a.pcd"), records);
    const std::string binary = read_file(path("a.pcd"));
    const std::string header = binary.substr(0, binary.find("DATA"));
    write("b.pcd", header + "DATA ascii\n" + text_of(records));
    write("c.pcd", compressed_pcd(binary, records));
    for (const char* name : {"a.pcd", "b.pcd", "c.pcd"}) {
      const PointRecords read = read_pcd(path(name));
      EXPECT_EQ(read.bytes, records.bytes) << name;
      EXPECT_EQ(read.size, records.size) << name;
      ASSERT_EQ(read.fields.size(), records.fields.size());
      EXPECT_EQ(read.fields.back().offset, records.fields.back().offset);
    }
  }
}

TEST_F(PointFiles, PlyOfAnyLayoutReadsBackInAllFormats) {
  auto rng = test::rng();
  for (int i = 0; i < 50; ++i) {
    const PointRecords records = random_records(rng, true);
    write_ply(path("little.ply"), records);
    const std::string little = read_file(path("little.ply"));
    std::string header = little.substr(0, little.find("end_header")) + "end_header\n";
    header.replace(header.find("binary_little_endian"), 20, "ascii");
    write("text.ply", header + text_of(records));
    header.replace(header.find("ascii"), 5, "binary_big_endian");
    write("big.ply", header + test::big_endian(records));
    EXPECT_EQ(read_ply(path("little.ply")).bytes, records.bytes);
    for (const Field& field : records.fields) {
      const auto expected = column(records, field.name.c_str());
      EXPECT_EQ(column(read_ply(path("text.ply")), field.name.c_str()), expected);
      EXPECT_EQ(column(read_ply(path("big.ply")), field.name.c_str()), expected);
    }
  }
}

TEST_F(PointFiles, PlySkipsElementsBeforeAndAfterTheVertices) {
  const std::string header =
      "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement camera 2\r\nproperty int id\r\n"
      "element vertex 1\r\nproperty float64 x\r\nproperty float y\r\nproperty float32 z\r\n"
      "element face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n";
  const MapCloud cloud =
      read_map_cloud(write("a.ply", header + "1\r\n2\r\n0.5 nan -1e3\r\n3 0 0 0\r\n"));
  ASSERT_EQ(cloud.positions.size(), 1U);
  EXPECT_EQ(cloud.positions[0].x(), 0.5);
  EXPECT_TRUE(std::isnan(cloud.positions[0].y()));
  EXPECT_EQ(cloud.positions[0].z(), -1000.0);
  EXPECT_TRUE(cloud.normals.empty());
}

TEST_F(PointFiles, MissingFileAndFolderAndUnknownExtensionAreErrors) {
  EXPECT_THAT(runtime_error_of([&] { read_points(path("no.pcd")); }), HasSubstr("cannot be read"));
  EXPECT_THAT(runtime_error_of([&] { read_points(path("a.xyz")); }), HasSubstr("is not a .pcd"));
  std::filesystem::create_directory(path("folder.ply"));
  EXPECT_THAT(
      runtime_error_of([&] { read_points(path("folder.ply")); }), HasSubstr("cannot be read"));
}

TEST_F(PointFiles, KittiScanMustBeWholePoints) {
  std::string bytes;
  for (const float value : {1.0F, 2.0F, 3.0F, 0.5F}) {
    append_bytes(value, bytes);
  }
  EXPECT_EQ(column(read_points(write("a.bin", bytes)), "intensity"), std::vector<double>{0.5});
  EXPECT_EQ(read_points(write("empty.bin", "")).size, 0U);
  EXPECT_THAT(
      runtime_error_of([&] { read_points(write("b.bin", bytes + "x")); }),
      HasSubstr("no whole number of 16-byte points"));
}

TEST_F(PointFiles, MapCloudReadsBackFromPlyAndPcd) {
  auto rng = test::rng();
  std::normal_distribution<double> normal;
  for (const double offset : {0.0, 1e6}) {
    MapCloud cloud;
    for (int i = 0; i < 100; ++i) {
      cloud.positions.emplace_back(offset + normal(rng), normal(rng), normal(rng));
      cloud.normals.push_back(
          Eigen::Vector3d(normal(rng), normal(rng), normal(rng)).normalized().cast<float>());
      cloud.sides.push_back(static_cast<std::uint8_t>(rng() % 2));
    }
    for (const char* name : {"map.ply", "map.pcd"}) {
      write_map_cloud(path(name), cloud);
      const MapCloud read = read_map_cloud(path(name));
      EXPECT_EQ(read.normals, cloud.normals);
      EXPECT_EQ(read.sides, cloud.sides);
      ASSERT_EQ(read.positions.size(), cloud.positions.size());
      for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        EXPECT_LT((read.positions[i] - cloud.positions[i]).norm(), 2e-4);
      }
    }
  }
}

TEST_F(PointFiles, MapCloudHasTheColumnsThatAreKept) {
  MapCloud cloud;
  for (int i = 0; i < 9; ++i) {
    cloud.positions.emplace_back(i, 0.0, 0.0);
    PointValues& values = cloud.values.emplace_back();
    values.intensity = 0.5F * static_cast<float>(i);
    values.time = 1e9 + 0.001 * i;
    values.color = {static_cast<std::uint8_t>(i), 200, 255};
    values.label = static_cast<std::uint16_t>(1000 * i);
  }
  cloud.columns.intensity = cloud.columns.time = cloud.columns.color = true;
  for (const char* name : {"map.ply", "map.pcd"}) {
    write_map_cloud(path(name), cloud);
    const PointRecords records = read_points(path(name));
    EXPECT_EQ(column(records, "intensity")[3], 1.5);
    EXPECT_EQ(column(records, "time")[3], 1e9 + 0.003);
    EXPECT_EQ(column(records, "red")[3], 3);
    EXPECT_EQ(column(records, "green")[3], 200);
    EXPECT_EQ(column(records, "blue")[3], 255);
    EXPECT_EQ(records.find({"label"}), nullptr);
  }
  cloud.values.pop_back();
  EXPECT_THROW(write_map_cloud(path("map.ply"), cloud), std::invalid_argument);
}

TEST_F(PointFiles, MapCloudWithoutNormalsOrOfUnequalLengths) {
  MapCloud cloud;
  cloud.positions = {Eigen::Vector3d(1, 2, 3)};
  write_map_cloud(path("map.ply"), cloud);
  EXPECT_TRUE(read_map_cloud(path("map.ply")).normals.empty());
  EXPECT_THROW(write_map_cloud(path("map.obj"), cloud), std::runtime_error);
  cloud.sides = {0, 1};
  EXPECT_THROW(write_map_cloud(path("map.ply"), cloud), std::invalid_argument);
  EXPECT_EQ(read_map_cloud(path("map.ply")).positions.size(), 1U);
}

TEST_F(PointFiles, AtomicFileLeavesNothingWithoutCommit) {
  write("a.txt", "old");
  {
    AtomicFile file(path("a.txt"));
    file.stream() << "half";
  }
  EXPECT_EQ(read_file(path("a.txt")), "old");
  AtomicFile file(path("a.txt"));
  file.stream() << "new";
  file.commit();
  EXPECT_EQ(read_file(path("a.txt")), "new");
  const std::filesystem::directory_iterator files(path(""));
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  EXPECT_THROW(AtomicFile(path("no/such/folder/a.txt")), std::runtime_error);
}

}  // namespace
}  // namespace nvm::io
