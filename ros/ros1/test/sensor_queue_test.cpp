// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sensor_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

namespace nvm_ros {
namespace {

using nvm::ImuSample;
using WhenFull = SensorQueue::WhenFull;

RawCloud cloud(double stamp) {
  RawCloud cloud;
  cloud.stamp = stamp;
  return cloud;
}

ImuSample reading(double time) { return {time, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()}; }

TEST(SensorQueue, GivesAScanTheReadingsUpToItsEnd) {
  SensorQueue queue(5, WhenFull::kDropOldest, true);
  for (const double time : {1.0, 1.1, 1.2, 1.3}) {
    queue.add(reading(time));
  }
  queue.add(cloud(1.0));
  const auto taken = queue.next_cloud();
  ASSERT_TRUE(taken);
  const auto readings = queue.imu_until(*taken, 1.2);
  ASSERT_TRUE(readings);
  ASSERT_EQ(readings->size(), 3U);
  EXPECT_EQ(readings->back().time, 1.2);
}

TEST(SensorQueue, WaitsForReadingsThatAreOnTheirWay) {
  SensorQueue queue(5, WhenFull::kDropOldest, true, 60.0);
  queue.add(reading(1.0));
  queue.add(cloud(1.0));
  const auto taken = queue.next_cloud();
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    queue.add(reading(1.1));
  });
  const auto readings = queue.imu_until(*taken, 1.1);
  later.join();
  ASSERT_TRUE(readings);
  EXPECT_EQ(readings->size(), 2U);
}

TEST(SensorQueue, DoesNotWaitForAnImuThatIsSilentOrMissing) {
  SensorQueue silent(5, WhenFull::kDropOldest, true, 0.01);
  SensorQueue without(5, WhenFull::kWait, false);
  for (SensorQueue* queue : {&silent, &without}) {
    queue->add(cloud(1.0));
    const auto taken = queue->next_cloud();
    const auto readings = queue->imu_until(*taken, 1.1);
    ASSERT_TRUE(readings);
    EXPECT_TRUE(readings->empty());
  }
  EXPECT_TRUE(silent.stats().imu_is_silent);
  silent.add(reading(2.0));
  EXPECT_FALSE(silent.stats().imu_is_silent);
}

TEST(SensorQueue, DropsTheOldestScanWhenFullAndCountsIt) {
  SensorQueue queue(2, WhenFull::kDropOldest, false);
  for (const double stamp : {1.0, 1.1, 1.2, 1.3}) {
    queue.add(cloud(stamp));
  }
  EXPECT_EQ(queue.stats().dropped, 2U);
  EXPECT_EQ(queue.next_cloud()->stamp, 1.2);
  EXPECT_EQ(queue.next_cloud()->stamp, 1.3);
}

TEST(SensorQueue, LetsTheProducerOfABagWaitInstead) {
  SensorQueue queue(2, WhenFull::kWait, true);
  std::thread producer([&] {
    for (int i = 0; i < 50; ++i) {
      queue.add(reading(i));
      queue.add(cloud(i));
    }
    queue.close();
  });
  int clouds = 0;
  std::size_t readings = 0;
  while (const auto taken = queue.next_cloud()) {
    EXPECT_EQ(taken->stamp, clouds++);
    readings += queue.imu_until(*taken, taken->stamp)->size();
  }
  producer.join();
  EXPECT_EQ(clouds, 50);
  EXPECT_EQ(readings, 50U);
  EXPECT_EQ(queue.stats().dropped, 0U);
}

TEST(SensorQueue, DoesNotWaitForEverForAnImuThatEndsBeforeTheBag) {
  SensorQueue queue(3, WhenFull::kWait, true);
  queue.add(reading(0.0));
  std::thread producer([&] {
    for (int i = 0; i < 10; ++i) {
      queue.add(cloud(i));
    }
    queue.close();
  });
  int clouds = 0;
  while (const auto taken = queue.next_cloud()) {
    EXPECT_TRUE(queue.imu_until(*taken, taken->stamp + 0.1));
    ++clouds;
  }
  producer.join();
  EXPECT_EQ(clouds, 10);
}

TEST(SensorQueue, BeginsAnewOnceWhenBothSensorsGoBackInTime) {
  for (const bool imu_first : {true, false}) {
    SensorQueue queue(10, WhenFull::kDropOldest, true);
    queue.add(reading(100.0));
    queue.add(cloud(100.0));
    if (imu_first) {
      queue.add(reading(10.0));
      queue.add(cloud(100.1));  // was on its way
      queue.add(cloud(10.0));
    } else {
      queue.add(cloud(10.0));
      queue.add(reading(100.1));
      queue.add(reading(10.0));
    }
    const auto taken = queue.next_cloud();
    EXPECT_EQ(taken->stamp, 10.0);
    EXPECT_EQ(taken->epoch, 1U);
    EXPECT_EQ(queue.imu_until(*taken, 10.0)->size(), 1U);
  }
}

TEST(SensorQueue, BeginsAnewWithoutAnImu) {
  SensorQueue queue(10, WhenFull::kDropOldest, false);
  queue.add(cloud(100.0));
  queue.add(cloud(10.0));
  queue.add(cloud(10.1));
  EXPECT_EQ(queue.next_cloud()->stamp, 10.0);
  EXPECT_EQ(queue.next_cloud()->epoch, 1U);
}

TEST(SensorQueue, LosesNothingOfABagWhoseTimeGoesBack) {
  SensorQueue queue(20, WhenFull::kWait, true);
  std::thread producer([&] {
    for (const double begin : {100.0, 10.0}) {
      for (int i = 0; i < 5; ++i) {
        queue.add(reading(begin + i));
        queue.add(cloud(begin + i));
      }
    }
    queue.close();
  });
  int clouds = 0;
  std::size_t readings = 0;
  while (const auto taken = queue.next_cloud()) {
    EXPECT_EQ(taken->epoch, clouds < 5 ? 0U : 1U);
    readings += queue.imu_until(*taken, taken->stamp)->size();
    ++clouds;
  }
  producer.join();
  EXPECT_EQ(clouds, 10);
  EXPECT_EQ(readings, 10U);
}

TEST(SensorQueue, LeavesOutReadingsThatRepeatGoBackALittleOrAreNotFinite) {
  SensorQueue queue(5, WhenFull::kDropOldest, true);
  queue.add(reading(1.0));
  queue.add(reading(1.0));
  queue.add(reading(0.9));
  ImuSample bad = reading(1.1);
  bad.gyro.x() = std::numeric_limits<double>::quiet_NaN();
  queue.add(bad);
  queue.add(reading(1.2));
  queue.add(cloud(1.0));
  EXPECT_EQ(queue.imu_until(*queue.next_cloud(), 1.2)->size(), 2U);
  EXPECT_EQ(queue.stats().bad_imu, 3U);
}

TEST(SensorQueue, KeepsABoundedNumberOfReadingsWhileNoScanComes) {
  SensorQueue queue(5, WhenFull::kDropOldest, true);
  for (int i = 0; i < 100'000; ++i) {
    queue.add(reading(0.001 * i));
  }
  queue.add(cloud(0.0));
  EXPECT_LE(queue.imu_until(*queue.next_cloud(), 100.0)->size(), 60'000U);
}

}  // namespace
}  // namespace nvm_ros
