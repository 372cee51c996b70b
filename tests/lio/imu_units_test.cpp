// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <gmock/gmock.h>

#include <utility>

#include "lio/imu_witness.hpp"

namespace nvm::lio {
namespace {

using test::ImuWitness;

TEST(ImuUnits, TurnsUnitsOfTheirOwnIntoItsOwn) {
  for (const double unit : {1000.0, 939.65, 0.05}) {
    ImuWitness witness;
    witness.reading = [&](double t) {
      ImuSample sample = witness.motion.imu(t);
      sample.gyro *= unit;
      return sample;
    };
    EXPECT_EQ(witness.verdict(6.0), ImuVerdict::kMended) << unit;
    EXPECT_THAT(
        witness.judge.findings(),
        ::testing::ElementsAre(
            ::testing::HasSubstr(unit > 1.0 ? "milliradians" : "a unit of its own")));
    const ImuSample mended = witness.judge.mended(witness.reading(2.0));
    EXPECT_LT((mended.gyro - witness.motion.imu(2.0).gyro).norm(), 0.1) << unit;
  }
  for (const double unit : {101.97, 100.0, 1670.7}) {
    ImuWitness witness;
    witness.reading = [&](double t) {
      ImuSample sample = witness.motion.imu(t);
      sample.accel *= unit;
      return sample;
    };
    EXPECT_EQ(witness.verdict(3.0), ImuVerdict::kMended) << unit;
    EXPECT_THAT(witness.judge.findings(), ::testing::ElementsAre(::testing::HasSubstr("counts")));
    EXPECT_NEAR(witness.judge.mended(witness.reading(2.0)).accel.norm(), 9.81, 1.5) << unit;
  }
}

TEST(ImuUnits, SwapsBackWhatTheDriverHasSwapped) {
  ImuWitness witness;
  for (int i = 0; i < 30; ++i) {
    witness.judge.add({0.01 * i, {0.0, 0.02, 9.8}, {0.01, 0.0, 0.0}});
  }
  EXPECT_THAT(witness.judge.findings(), ::testing::ElementsAre(::testing::HasSubstr("swapped")));
  const ImuSample mended = witness.judge.mended({1.0, {0.0, 0.0, 9.8}, {0.3, 0.0, 0.0}});
  EXPECT_EQ(mended.accel, Eigen::Vector3d(0.0, 0.0, 9.8));
  EXPECT_EQ(mended.gyro, Eigen::Vector3d(0.3, 0.0, 0.0));
}

TEST(ImuUnits, NamesTheAxesOfALeftHandedGyroscope) {
  Eigen::Matrix3d turned = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
  Eigen::Matrix3d swapped;
  swapped << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  for (const auto& [axes, name] : {std::pair{turned, "(-x, y, z)"}, {swapped, "(y, x, z)"}}) {
    ImuWitness witness;
    witness.reading = [&witness, &axes = axes](double t) {
      ImuSample sample = witness.motion.imu(t);
      sample.gyro = (axes * sample.gyro).eval();
      return sample;
    };
    EXPECT_EQ(witness.verdict(8.0), ImuVerdict::kUnusable);
    EXPECT_THAT(witness.judge.findings()[0], ::testing::HasSubstr(name));
  }
}

TEST(ImuUnits, NamesScansThatAreAMirrorImage) {
  for (int axis = 0; axis < 3; ++axis) {
    ImuWitness witness;
    Pose mirror = Pose::Identity();
    mirror.linear()(axis, axis) = -1.0;
    witness.mirror = mirror;
    EXPECT_EQ(witness.verdict(12.0), ImuVerdict::kUnusable);
    EXPECT_THAT(witness.judge.findings()[0], ::testing::HasSubstr("mirror image")) << axis;
  }
}

}  // namespace
}  // namespace nvm::lio
