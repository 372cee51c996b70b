// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// Rows of imu.csv as loggers write them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "io/nvm_sequence_fixture.hpp"
#include "support/rng.hpp"

namespace nvm::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(NvmSequence, BadImuRowsAreLeftOutAndCounted) {
  edit("imu.csv", "10.005000000", "10.000000000");
  EXPECT_THAT(
      read(),
      ElementsAre(AllOf(
          HasSubstr("1 rows of imu.csv are left out; the first: "),
          HasSubstr("imu.csv:3: the time is that of another sample"))));
  edit("imu.csv", "\n10.000000000,0.100000000", "\n9.999000000,inf");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("imu.csv:2: 'inf' is not a finite number")));
  edit("imu.csv", "9.999000000,inf", "9.999000000,-1e160");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("imu.csv:2: a reading is absurd")));
  edit("imu.csv", "9.999000000,-1e160", "9.999000000,0.1,0.1");
  EXPECT_THAT(read(), ElementsAre(HasSubstr("imu.csv:2: has 8 values instead of 7")));
}

TEST_F(NvmSequence, ImuRowsThatAreLateByLessThanHalfASecondAreSorted) {
  const auto in_order = some_imu();
  auto shuffled = in_order;
  auto random = test::rng();
  for (std::size_t i = 0; i + 50 <= shuffled.size(); i += 50) {  // a quarter of a second
    const auto begin = shuffled.begin() + static_cast<std::ptrdiff_t>(i);
    std::shuffle(begin, begin + 50, random);
  }
  std::string rows = "t,gx,gy,gz,ax,ay,az\n";
  for (const ImuSample& sample : shuffled) {
    rows += std::to_string(sample.time) + ",0,0,0,0,0,9.81\n";
  }
  write("s/imu.csv", rows);
  EXPECT_THAT(read(), ElementsAre(HasSubstr("rows of imu.csv are not in order of time")));
  const auto samples = open_sequence(path("s"))->imu_until(1e9);
  ASSERT_EQ(samples.size(), in_order.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].time, in_order[i].time, 1e-6);
  }
}

// One time of another epoch would have every later row be late.
TEST_F(NvmSequence, OneImuRowOfAnotherTimeTakesNoOtherWithIt) {
  edit("imu.csv", "10.5000", "99990.5000");
  const auto reader = open_sequence(path("s"));
  EXPECT_EQ(reader->imu_until(11.25).size(), some_imu().size() - 1);
}

}  // namespace
}  // namespace nvm::io
