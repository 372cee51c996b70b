// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "io/cloud/pcd.hpp"
#include "io/cloud/ply.hpp"
#include "io/damage.hpp"
#include "io/encoded_records.hpp"
#include "io/file/file.hpp"
#include "io/temporary_folder.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using test::compressed_pcd;
using test::pcd_header;
using test::random_records;
using test::runtime_error_of;
using ::testing::HasSubstr;

class HostilePointFiles : public test::TemporaryFolder {};

const char* const kThreeFloats =
    "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n";

TEST_F(HostilePointFiles, PcdHeadersAreNamedAndAllocateNothing) {
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
  EXPECT_THAT(error_of(layout + "WIDTH 1\nCOUNT 0\n"), HasSubstr("truncated"));
  EXPECT_THAT(
      error_of(layout + "WIDTH 1\nCOUNT 18446744073709551615\n"), HasSubstr("is above 1048576"));
  EXPECT_THAT(error_of("FIELDS x\nSIZE -4\nTYPE F\nWIDTH 1\n"), HasSubstr("SIZE '-4'"));
  EXPECT_THAT(
      error_of("FIELDS x\nSIZE 3\nTYPE F\nWIDTH 1\n"),
      HasSubstr("TYPE 'F' and SIZE 3 is not known"));
  EXPECT_THAT(error_of("FIELDS x y\nSIZE 4\nTYPE F\nWIDTH 1\n"), HasSubstr("differ in length"));
  EXPECT_THAT(error_of("WIDTH 1\n"), HasSubstr("missing"));
  EXPECT_THAT(error_of(kThreeFloats, "DATA zip\n"), HasSubstr("DATA 'zip' is not known"));
  EXPECT_THAT(error_of(kThreeFloats, ""), HasSubstr("no DATA line"));
  for (const char* data : {"DATA ascii\n1 2 3\n", "DATA ascii\n1 2 3\n1 2\n"}) {
    EXPECT_EQ(read_pcd(write("cut.pcd", pcd_header(kThreeFloats) + data)).missing, 1U);
  }
  EXPECT_THAT(error_of(kThreeFloats, "DATA ascii\n1 2 b\n"), HasSubstr("point 0 is not"));
  EXPECT_THAT(error_of("\x1b[2J\n"), HasSubstr("is no PCD file: unknown header entry '?[2J'"));
}

TEST_F(HostilePointFiles, PlyHeadersAreNamedAndAllocateNothing) {
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

TEST_F(HostilePointFiles, DamagedFilesNeverDoMoreThanThrow) {
  auto rng = test::rng();
  PointRecords records = random_records(rng, true);
  while (records.size < 5) {
    records = random_records(rng, true);
  }
  write_pcd(path("a.pcd"), records);
  write_ply(path("a.ply"), records);
  const std::string pcd = read_file(path("a.pcd"));
  const std::string ply = read_file(path("a.ply"));
  const std::string ascii =
      pcd.substr(0, pcd.find("DATA")) + "DATA ascii\n" + test::text_of(records);
  for (const std::string& bytes : {pcd, ascii, compressed_pcd(pcd, records)}) {
    test::read_damaged(
        bytes, rng, [&](const std::string& damaged) { read_pcd(write("damaged.pcd", damaged)); });
  }
  test::read_damaged(
      ply, rng, [&](const std::string& damaged) { read_ply(write("damaged.ply", damaged)); });
}

TEST_F(HostilePointFiles, TruncatedDataAreAnErrorOrMissing) {
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
      const std::string file = write("cut.pcd", whole.substr(0, size));
      try {
        const PointRecords cut = read_pcd(file);
        EXPECT_GT(cut.missing, 0U) << size;
        EXPECT_EQ(cut.size + cut.missing, records.size) << size;
      } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("cut.pcd: ")) << size;
      }
    }
  }
}

}  // namespace
}  // namespace nvm::io
