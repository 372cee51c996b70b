// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/message_clock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/rng.hpp"

namespace nvm::io {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Messages every `period`, recorded `delay` after their stamps.
std::vector<MessageTime> messages(double first, double period, double delay, int count) {
  std::vector<MessageTime> times;
  for (int i = 0; i < count; ++i) {
    const double stamp = first + period * i;
    times.push_back({stamp, stamp + delay});
  }
  return times;
}

TEST(MessageClock, LeavesOutWhatRepeatsOrIsLate) {
  auto times = messages(50.0, 0.05, 0.06, 30);
  times.insert(times.begin() + 11, {times[10].stamp, times[10].record + 0.004});
  std::swap(times[20].stamp, times[21].stamp);
  MessageClock clock(times, ClockChoice::kAutomatic, true);
  std::vector<std::size_t> left_out;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!clock.date(times[i])) {
      left_out.push_back(i);
    }
  }
  EXPECT_EQ(left_out, (std::vector<std::size_t>{11, 21}));
}

TEST(MessageClock, OneJumpingStampCostsOneMessage) {
  for (const double jump : {-30.0, -0.7, 45.0, 1e9}) {
    auto times = messages(2000.0, 0.1, 0.1, 30);
    times[12].stamp += jump;
    MessageClock clock(times, ClockChoice::kAutomatic, true);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto time = clock.date(times[i]);
      EXPECT_EQ(time.has_value(), i != 12) << jump << " " << i;
    }
  }
}

TEST(MessageClock, TakesAJumpThatLastsOffTheStamps) {
  for (const double jump : {-2.5, 0.9, 3600.0}) {
    auto times = messages(2000.0, 0.01, 0.002, 300);
    for (std::size_t i = 100; i < 200; ++i) {
      times[i].stamp += jump;
    }
    MessageClock clock({times.begin(), times.begin() + 50}, ClockChoice::kAutomatic, false);
    int left_out = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto time = clock.date(times[i]);
      left_out += time ? 0 : 1;
      EXPECT_NEAR(time.value_or(times[i].record - 0.002), times[i].record - 0.002, 1e-6) << i;
    }
    EXPECT_EQ(left_out, 2) << jump;
    EXPECT_THAT(clock.jump_note("clouds").value_or(""), HasSubstr("jump 1 times"));
  }
}

// The first stamps are those of a sensor that does not know the time yet.
TEST(MessageClock, FirstStampsThatAreFarOffAreLeftOut) {
  for (const double stamp : {0.0, 1e9}) {
    auto times = messages(2000.0, 0.1, 0.1, 30);
    for (int i = 0; i < 3; ++i) {
      times[i].stamp = stamp + 0.1 * i;
    }
    MessageClock clock({times.begin(), times.begin() + 20}, ClockChoice::kAutomatic, true);
    for (int i = 0; i < 30; ++i) {
      const auto time = clock.date(times[i]);
      EXPECT_EQ(time.has_value(), i >= 3) << i;
      EXPECT_NEAR(time.value_or(times[i].record - 0.1), times[i].record - 0.1, 1e-6) << i;
    }
    EXPECT_FALSE(clock.jump_note("clouds"));
  }
}

TEST(MessageClock, RecordTimesThatAreOfNoUseLeaveNothingOut) {
  auto times = messages(2000.0, 0.1, 0.1, 60);
  for (MessageTime& time : times) {
    time.record = 5.0;  // as some converters write
  }
  MessageClock clock({times.begin(), times.begin() + 20}, ClockChoice::kAutomatic, true);
  for (const MessageTime& time : times) {
    EXPECT_EQ(clock.date(time), time.stamp);
  }
}

TEST(MessageClock, AGapIsNoJump) {
  auto times = messages(0.0, 0.1, 0.02, 40);
  times.erase(times.begin() + 5, times.begin() + 30);
  MessageClock clock(times, ClockChoice::kAutomatic, true);
  for (const MessageTime& time : times) {
    EXPECT_EQ(clock.date(time), time.stamp);
  }
}

TEST(MessageClock, DatesByRecordTimesWhenStampsStandStill) {
  std::vector<MessageTime> times;
  for (int i = 0; i < 20; ++i) {
    times.push_back({i == 3 ? 7.0 : 0.0, 300.0 + 0.1 * i});
  }
  MessageClock clock(times, ClockChoice::kAutomatic, true);
  EXPECT_TRUE(clock.uses_record());
  EXPECT_EQ(clock.date(times[4]), 300.4);
  EXPECT_FALSE(MessageClock(times, ClockChoice::kHeader, true).uses_record());
}

TEST(MessageClock, SmoothsJitter) {
  auto rng = test::rng();
  std::uniform_real_distribution<double> noise(0.0, 0.02);
  auto times = messages(1000.0, 0.05, 0.05, 400);
  for (MessageTime& time : times) {
    time.stamp += noise(rng);
    time.record = time.stamp + 0.05;
  }
  times.erase(times.begin() + 50, times.begin() + 60);
  MessageClock clock({times.begin(), times.begin() + 20}, ClockChoice::kAutomatic, true);
  ASSERT_TRUE(clock.smooths());
  EXPECT_NEAR(clock.jitter(), 0.005, 0.003);
  double sum = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double truth = 1000.01 + 0.05 * static_cast<double>(i < 50 ? i : i + 10);
    const double error = clock.date(times[i]).value_or(0.0) - truth;
    EXPECT_LT(std::abs(error), 0.007) << i;
    sum += error * error;
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(times.size())), 0.002);
}

TEST(MessageClock, OneStampOffTheLineIsNoJitter) {
  auto times = messages(1000.0, 0.1, 0.1, 20);
  times[0].stamp += 0.08;  // the recording began within a sweep
  const MessageClock clock(times, ClockChoice::kAutomatic, true);
  EXPECT_FALSE(clock.smooths());
}

TEST(Clocks, TheTopicOfAnotherClockIsDatedByRecordTimes) {
  auto clouds = messages(500.0, 0.1, 0.1, 20);
  const auto imu = messages(500.0, 0.005, 0.001, 100);
  EXPECT_THAT(choose_clocks(clouds, imu, ClockChoice::kAutomatic).notes, SizeIs(0));
  for (MessageTime& time : clouds) {
    time.stamp += 40.0;
  }
  const Clocks clocks = choose_clocks(clouds, imu, ClockChoice::kAutomatic);
  EXPECT_TRUE(clocks.cloud.uses_record());
  EXPECT_FALSE(clocks.imu.uses_record());
  ASSERT_THAT(clocks.notes, SizeIs(1));
  EXPECT_THAT(clocks.notes[0], HasSubstr("the stamps of the clouds are 39.900 s from the record"));
  EXPECT_FALSE(choose_clocks(clouds, imu, ClockChoice::kHeader).cloud.uses_record());
  EXPECT_FALSE(choose_clocks(clouds, {}, ClockChoice::kAutomatic).cloud.uses_record());
}

}  // namespace
}  // namespace nvm::io
