// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// What a path is taken for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "io/sequence/sequence_reader.hpp"
#include "io/temporary_folder.hpp"

namespace nvm::io {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class OpenSequence : public test::TemporaryFolder {
 protected:
  static std::string error_of(const std::string& path) {
    return test::runtime_error_of([&] { open_sequence(path); });
  }

  // Three numbers a point.
  std::string write_scan(const std::string& name) const {
    return write(name, std::string(5 * 12, '\0'));
  }
};

TEST_F(OpenSequence, OtherPathsAreNoSequence) {
  EXPECT_THAT(error_of(path("none")), HasSubstr("none: does not exist"));
  EXPECT_THAT(error_of(write("a.dat", "")), HasSubstr("is no sequence"));
}

TEST_F(OpenSequence, FilesOfOtherKindsComeWithWhatToDo) {
  EXPECT_THAT(error_of(write("a.PCAP", "?")), HasSubstr("of the Python package"));
  EXPECT_THAT(error_of(write("a.laz", "?")), HasSubstr("CloudCompare"));
  EXPECT_THAT(error_of(write("a.bag.gz", "?")), HasSubstr("unpack it"));
}

TEST_F(OpenSequence, Ros2BagsAreSentToTheConverter) {
  write_scan("scans/a.bin");
  write("scans/metadata.yaml", "author: somebody\n");
  EXPECT_EQ(open_sequence(path("scans"))->info().scan_count, 1U);
  write("scans/run_0.db3", "");  // whatever that is doing there
  EXPECT_EQ(open_sequence(path("scans"))->info().scan_count, 1U);
  write("scans/metadata.yaml", "rosbag2_bagfile_information:\n  version: 9\n");
  EXPECT_THAT(error_of(path("scans")), HasSubstr("docs/python.md"));
  EXPECT_THAT(error_of(write("a.mcap", "")), HasSubstr("docs/python.md"));
  write("ros2/run_0.db3", "");  // whose metadata are lost
  EXPECT_THAT(error_of(path("ros2")), HasSubstr("docs/python.md"));
}

TEST_F(OpenSequence, BagsAreKnownByTheirFirstBytesToo) {
  const std::string bag = "#ROSBAG V2.0\n";
  for (const std::string name : {"run.bag.active", "run.bag.orig", "run"}) {
    EXPECT_THAT(error_of(write(name, bag)), Not(HasSubstr("is no sequence"))) << name;
  }
  write("parts/run_1.bag.active", bag);
  EXPECT_THAT(error_of(path("parts")), HasSubstr("run_1.bag.active: "));
}

}  // namespace
}  // namespace nvm::io
