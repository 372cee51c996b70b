// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/cloud_stream.hpp"

#include <gmock/gmock.h>

#include <stdexcept>
#include <string>

namespace nvm::io {
namespace {

using ::testing::HasSubstr;

/// Why `stream` refuses a cloud of `frame` with `points`; empty when it does not.
std::string refusal(
    CloudStream& stream, double time, const std::string& frame, const std::string& points) {
  CloudMessage cloud;
  cloud.frame = frame;
  cloud.records.bytes = points;
  try {
    stream.check(cloud, time);
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(CloudStream, TakesOneOfTwoLidarsThatComeInTurn) {
  CloudStream stream;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(refusal(stream, 0.1 * i, "left", "a" + std::to_string(i)), "");
    EXPECT_THAT(
        refusal(stream, 0.1 * i + 0.05, "right", "b" + std::to_string(i)),
        HasSubstr("is of frame 'right', not 'left'"));
  }
}

TEST(CloudStream, FollowsALidarWhoseFrameIsNamedAnew) {
  CloudStream stream;
  EXPECT_EQ(refusal(stream, 0.0, "lidar", "a"), "");
  EXPECT_NE(refusal(stream, 0.1, "os_lidar", "b"), "");
  EXPECT_EQ(refusal(stream, 1.1, "os_lidar", "c"), "");
  EXPECT_EQ(refusal(stream, 1.2, "os_lidar", "d"), "");
}

TEST(CloudStream, TakesACloudThatIsSentTwiceOnce) {
  CloudStream stream;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(refusal(stream, 0.1 * i, "", std::to_string(i)), "");
    EXPECT_EQ(refusal(stream, 0.1 * i + 0.05, "", std::to_string(i)).empty(), i < 3) << i;
  }
}

TEST(CloudStream, TakesAWorldInWhichNothingChanges) {
  CloudStream stream;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(refusal(stream, 0.1 * i, "", "same"), "");
  }
}

}  // namespace
}  // namespace nvm::io
