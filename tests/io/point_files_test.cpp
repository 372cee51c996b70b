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

#include "io/damage.hpp"
#include "io/file.hpp"
#include "io/lzf.hpp"
#include "io/map_cloud.hpp"
#include "io/pcd.hpp"
#include "io/ply.hpp"
#include "io/point_records.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::runtime_error_of;
using ::testing::HasSubstr;

class PointFiles : public test::TemporaryFolder {};

std::vector<double> column(const PointRecords& records, const char* name) {
  std::vector<double> values;
  const Field* field = records.find({name});
  if (field != nullptr) {
    for_each_value(records, *field, [&](std::size_t, double value) { values.push_back(value); });
  }
  return values;
}

constexpr ScalarType kAllTypes[] = {
    ScalarType::kInt8,
    ScalarType::kUint8,
    ScalarType::kInt16,
    ScalarType::kUint16,
    ScalarType::kInt32,
    ScalarType::kUint32,
    ScalarType::kInt64,
    ScalarType::kUint64,
    ScalarType::kFloat32,
    ScalarType::kFloat64};

/// Random whole numbers in fields of all types, in random order, some with a count above 1.
PointRecords random_records(std::mt19937_64& rng, bool only_ply_types) {
  PointRecords records;
  const std::size_t field_count = 1 + rng() % 8;
  for (std::size_t i = 0; i < field_count; ++i) {
    const ScalarType type = kAllTypes[rng() % 10];
    const bool is_long = type == ScalarType::kInt64 || type == ScalarType::kUint64;
    const std::string name = "f" + std::to_string(i);
    if (only_ply_types) {
      records.add_field(name, is_long ? ScalarType::kUint8 : type);
    } else {
      records.add_field(name, type, 1 + rng() % 3);
    }
  }
  records.size = rng() % 20;
  for (std::size_t i = 0; i < records.size; ++i) {
    for (const Field& field : records.fields) {
      for (std::size_t k = 0; k < field.count; ++k) {
        visit_type(field.type, [&](auto zero) {
          append_bytes(static_cast<decltype(zero)>(rng() % 128), records.bytes);
        });
      }
    }
  }
  return records;
}

/// The values of `records` as text, one record a line.
std::string text_of(const PointRecords& records) {
  std::string text;
  for (std::size_t i = 0; i < records.size; ++i) {
    for (const Field& field : records.fields) {
      for (std::size_t k = 0; k < field.count; ++k) {
        visit_type(field.type, [&](auto value) {
          const std::size_t at = i * records.record_size + field.offset + k * sizeof(value);
          std::memcpy(&value, &records.bytes[at], sizeof(value));
          text += std::to_string(value) + " ";
        });
      }
    }
    text += "\n";
  }
  return text;
}

/// The bytes of `records` in big endian.
std::string big_endian(PointRecords records) {
  for (std::size_t i = 0; i < records.size; ++i) {
    for (const Field& field : records.fields) {
      const auto begin = records.bytes.begin() +
                         static_cast<std::ptrdiff_t>(i * records.record_size + field.offset);
      std::reverse(begin, begin + static_cast<std::ptrdiff_t>(size_of(field.type)));
    }
  }
  return records.bytes;
}

/// A simple LZF encoder: the longest match by brute force, so that copies of all kinds appear.
std::string lzf_compress(const std::string& data) {
  std::string output;
  std::string literals;
  const auto flush = [&] {
    for (std::size_t at = 0; at < literals.size(); at += 32) {
      const std::string run = literals.substr(at, 32);
      output += static_cast<char>(run.size() - 1) + run;
    }
    literals.clear();
  };
  for (std::size_t at = 0; at < data.size();) {
    std::size_t best_length = 0;
    std::size_t best_distance = 0;
    for (std::size_t distance = 1; distance <= std::min<std::size_t>(at, 8192); ++distance) {
      std::size_t length = 0;
      while (length < 264 && at + length < data.size() &&
             data[at + length] == data[at + length - distance]) {
        ++length;
      }
      if (length > best_length) {
        best_length = length;
        best_distance = distance;
      }
    }
    if (best_length < 3) {
      literals += data[at++];
      continue;
    }
    flush();
    const std::size_t code = best_length - 2;
    const std::size_t offset = best_distance - 1;
    output += static_cast<char>((std::min<std::size_t>(code, 7) << 5) | (offset >> 8));
    if (code >= 7) {
      output += static_cast<char>(code - 7);
    }
    output += static_cast<char>(offset & 255);
    at += best_length;
  }
  flush();
  return output;
}

/// `header` of a binary PCD file of `records` with their data compressed.
std::string compressed_pcd(const std::string& binary_pcd, const PointRecords& records) {
  std::string columns;
  for (const Field& field : records.fields) {
    for (std::size_t i = 0; i < records.size; ++i) {
      columns += records.bytes.substr(
          i * records.record_size + field.offset, size_of(field.type) * field.count);
    }
  }
  const std::string compressed = lzf_compress(columns);
  std::string file = binary_pcd.substr(0, binary_pcd.find("DATA")) + "DATA binary_compressed\n";
  append_bytes(static_cast<std::uint32_t>(compressed.size()), file);
  append_bytes(static_cast<std::uint32_t>(columns.size()), file);
  return file + compressed;
}

std::string pcd_header(const std::string& lines) { return "# .PCD v0.7\nVERSION 0.7\n" + lines; }

const char* const kThreeFloats =
    "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n";

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
    write("big.ply", header + big_endian(records));
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

TEST_F(PointFiles, HostilePcdHeadersAreNamedAndAllocateNothing) {
  const auto error_of = [&](const std::string& header, const std::string& data = "DATA ascii\n") {
    const std::string file = write("bad.pcd", pcd_header(header) + data);
    const std::string error = runtime_error_of([&] { read_pcd(file); });
    EXPECT_EQ(error.rfind(file + ": ", 0), 0U) << error;
    return error.substr(std::min(error.size(), file.size() + 2));
  };
  const std::string layout = "FIELDS x\nSIZE 4\nTYPE F\n";
  for (const char* data : {"DATA ascii\n", "DATA binary\n"}) {
    EXPECT_THAT(error_of(layout + "WIDTH 1000000000000\nHEIGHT 1\n", data), HasSubstr("truncated"));
  }
  EXPECT_THAT(
      error_of(layout + "WIDTH 1000000000000\n", "DATA binary_compressed\n12345678"),
      HasSubstr("truncated"));
  EXPECT_THAT(error_of(layout + "WIDTH 4294967296\nHEIGHT 4294967296\n"), HasSubstr("contradict"));
  EXPECT_THAT(error_of(layout + "WIDTH 2\nPOINTS 3\n"), HasSubstr("contradict"));
  EXPECT_THAT(error_of(layout), HasSubstr("missing"));
  EXPECT_THAT(error_of(layout + "WIDTH -1\n"), HasSubstr("WIDTH '-1' is no whole number"));
  EXPECT_THAT(error_of(layout + "WIDTH 1\nCOUNT 0\n"), HasSubstr("COUNT 0 of field 'x'"));
  EXPECT_THAT(
      error_of(layout + "WIDTH 1\nCOUNT 18446744073709551615\n"), HasSubstr("is not from 1"));
  EXPECT_THAT(error_of("FIELDS x\nSIZE -4\nTYPE F\nWIDTH 1\n"), HasSubstr("SIZE '-4'"));
  EXPECT_THAT(
      error_of("FIELDS x\nSIZE 3\nTYPE F\nWIDTH 1\n"),
      HasSubstr("TYPE 'F' and SIZE 3 is not known"));
  EXPECT_THAT(error_of("FIELDS x y\nSIZE 4\nTYPE F\nWIDTH 1\n"), HasSubstr("differ in length"));
  EXPECT_THAT(error_of("WIDTH 1\n"), HasSubstr("missing"));
  EXPECT_THAT(error_of(kThreeFloats, "DATA zip\n"), HasSubstr("DATA 'zip' is not known"));
  EXPECT_THAT(error_of(kThreeFloats, ""), HasSubstr("no DATA line"));
  EXPECT_THAT(error_of(kThreeFloats, "DATA ascii\n1 2 3\n"), HasSubstr("1 of 2 points"));
  EXPECT_THAT(error_of(kThreeFloats, "DATA ascii\n1 2 3\n1 2\n"), HasSubstr("point 1 is not"));
  EXPECT_THAT(error_of(kThreeFloats, "DATA ascii\n1 2 b\n"), HasSubstr("point 0 is not"));
  EXPECT_THAT(error_of("\x1b[2J\n"), HasSubstr("is no PCD file: unknown header entry '?[2J'"));
}

TEST_F(PointFiles, HostilePlyHeadersAreNamedAndAllocateNothing) {
  const auto error_of = [&](const std::string& lines, const std::string& format = "ascii") {
    const std::string file =
        write("bad.ply", "ply\nformat " + format + " 1.0\n" + lines + "end_header\n");
    const std::string error = runtime_error_of([&] { read_ply(file); });
    EXPECT_EQ(error.rfind(file + ": ", 0), 0U) << error;
    return error;
  };
  const std::string vertex = "element vertex 1000000000000\n";
  for (const char* format : {"ascii", "binary_little_endian"}) {
    EXPECT_THAT(error_of(vertex + "property float x\n", format), HasSubstr("truncated"));
  }
  EXPECT_THAT(error_of(vertex, "binary_big_endian"), HasSubstr("truncated"));
  EXPECT_THAT(error_of(vertex + "property float x\n", "zip"), HasSubstr("format 'zip'"));
  EXPECT_THAT(error_of(vertex + "property list uchar int x\n"), HasSubstr("list properties"));
  EXPECT_THAT(error_of(vertex + "property half x\n"), HasSubstr("'half' is not known"));
  EXPECT_THAT(error_of("element vertex -1\n"), HasSubstr("'-1' is no whole number"));
  EXPECT_THAT(error_of("property float x\n"), HasSubstr("unknown header line"));
  EXPECT_THAT(error_of(""), HasSubstr("no element 'vertex'"));
  EXPECT_THAT(runtime_error_of([&] { read_ply(write("e.ply", "")); }), HasSubstr("is no PLY"));
}

TEST_F(PointFiles, DamagedFilesNeverDoMoreThanThrow) {
  auto rng = test::rng();
  PointRecords records = random_records(rng, true);
  while (records.size < 5) {
    records = random_records(rng, true);
  }
  write_pcd(path("a.pcd"), records);
  write_ply(path("a.ply"), records);
  const std::string pcd = read_file(path("a.pcd"));
  const std::string ply = read_file(path("a.ply"));
  const std::string ascii = pcd.substr(0, pcd.find("DATA")) + "DATA ascii\n" + text_of(records);
  for (const std::string& bytes : {pcd, ascii, compressed_pcd(pcd, records)}) {
    test::read_damaged(
        bytes, rng, [&](const std::string& damaged) { read_pcd(write("damaged.pcd", damaged)); });
  }
  test::read_damaged(
      ply, rng, [&](const std::string& damaged) { read_ply(write("damaged.ply", damaged)); });
}

TEST_F(PointFiles, TruncatedDataAreAlwaysAnError) {
  auto rng = test::rng();
  PointRecords records;
  for (const char* name : {"x", "y", "z"}) {
    records.add_field(name, ScalarType::kFloat32);
  }
  records.size = 10;
  for (int i = 0; i < 120; ++i) {
    records.bytes += static_cast<char>(rng());
  }
  write_pcd(path("a.pcd"), records);
  const std::string binary = read_file(path("a.pcd"));
  for (const std::string& whole : {binary, compressed_pcd(binary, records)}) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_THROW(read_pcd(write("cut.pcd", whole.substr(0, size))), std::runtime_error) << size;
    }
  }
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

TEST(Lzf, ExpandsWhatIsCompressed) {
  auto rng = test::rng();
  for (std::size_t alphabet = 1; alphabet <= 256; alphabet *= 4) {
    std::string data;
    const std::size_t size = rng() % 3000;
    while (data.size() < size) {
      data += static_cast<char>(rng() % alphabet);
    }
    EXPECT_EQ(lzf_decompress(lzf_compress(data), data.size()), data);
    EXPECT_EQ(lzf_decompress(lzf_compress(data), data.size() + 1), std::nullopt);
  }
  EXPECT_EQ(lzf_decompress("", 0), "");
}

TEST(Lzf, RefusesWhatCannotBe) {
  EXPECT_EQ(lzf_decompress(std::string(2, '\0'), std::size_t{1} << 40), std::nullopt);
  EXPECT_EQ(lzf_decompress("\x20\x05", 3), std::nullopt);  // copies from before the begin
  EXPECT_EQ(lzf_decompress("\x05xx", 6), std::nullopt);    // literals cut off
}

}  // namespace
}  // namespace nvm::io
