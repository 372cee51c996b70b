// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "finding_watch.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace nvm_ros {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FindingWatch, SaysEachKindOnceWhateverItsNumbers) {
  FindingWatch watch;
  EXPECT_THAT(watch.new_ones(0.0, {"the clock is 12 ms late"}), IsEmpty());
  EXPECT_THAT(
      watch.new_ones(5.0, {"the clock is 9.5 ms late", "3 readings are left out: NaN"}),
      ElementsAre("the clock is 9.5 ms late"));
  EXPECT_THAT(watch.new_ones(9.0, {"the clock is -2 ms late"}), IsEmpty());
  EXPECT_THAT(watch.new_ones(12.0, {}), IsEmpty());
  EXPECT_THAT(watch.new_ones(30.0, {"the clock is 7 ms late"}), IsEmpty());
}

TEST(FindingWatch, SaysNothingThatDoesNotLast) {
  FindingWatch watch;
  for (const double time : {0.0, 1.0, 4.0, 12.0}) {
    EXPECT_THAT(
        watch.new_ones(
            time, time == 4.0 ? std::vector<std::string>{} : std::vector<std::string>{"a"}),
        IsEmpty());
  }
  EXPECT_THAT(watch.new_ones(std::numeric_limits<double>::infinity(), {"a"}), ElementsAre("a"));
}

}  // namespace
}  // namespace nvm_ros
