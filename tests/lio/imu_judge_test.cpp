// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_judge.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <stdexcept>

#include "lio/imu_witness.hpp"

namespace nvm::lio {
namespace {

using test::ImuWitness;

constexpr double kDegree = 0.017453292519943295;

TEST(ImuJudge, BelievesAnImuThatTellsTheScansMotion) {
  ImuWitness witness;
  EXPECT_EQ(witness.verdict(6.0), ImuVerdict::kGood);
  EXPECT_TRUE(witness.judge.findings().empty());
  const auto motion = witness.judge.motion();
  ASSERT_TRUE(motion);
  EXPECT_LT((motion->velocity - witness.motion.velocity(5.99)).norm(), 0.05);
  EXPECT_LT((motion->gravity - Eigen::Vector3d(0.0, 0.0, -9.81)).norm(), 0.3);
}

TEST(ImuJudge, TurnsDegreesIntoRadians) {
  ImuWitness witness;
  witness.reading = [&](double t) {
    ImuSample sample = witness.motion.imu(t);
    sample.gyro /= kDegree;
    return sample;
  };
  EXPECT_EQ(witness.verdict(6.0), ImuVerdict::kMended);
  EXPECT_THAT(witness.judge.findings()[0], ::testing::HasSubstr("degrees per second"));
  const ImuSample mended = witness.judge.mended(witness.reading(2.0));
  EXPECT_LT((mended.gyro - witness.motion.imu(2.0).gyro).norm(), 1e-6);
}

TEST(ImuJudge, MendsAGyroscopesScaleAlone) {
  for (const double scale : {0.8, 1.1, 1.2}) {
    ImuWitness witness;
    witness.reading = [&](double t) {
      ImuSample sample = witness.motion.imu(t);
      sample.gyro = scale * sample.gyro + Eigen::Vector3d(0.0, 0.0, 0.03);  // not taken for scale
      return sample;
    };
    EXPECT_EQ(witness.verdict(8.0), ImuVerdict::kMended) << scale;
    EXPECT_THAT(
        witness.judge.findings(),
        testing::ElementsAre(testing::HasSubstr(scale > 1.0 ? "too much" : "too little")));
    const Eigen::Vector3d mended =
        witness.judge.mended({0.0, {0.0, 0.0, scale}, Eigen::Vector3d::Zero()}).gyro;
    EXPECT_NEAR(mended.z(), 1.0, 0.02) << scale;
  }
  ImuWitness biased;
  biased.reading = [&](double t) {
    ImuSample sample = biased.motion.imu(t);
    sample.gyro += Eigen::Vector3d(0.03, -0.03, 0.03);
    return sample;
  };
  biased.verdict(8.0);
  EXPECT_THAT(biased.judge.findings(), testing::IsEmpty());
}

TEST(ImuJudge, TurnsGIntoMetresPerSquareSecond) {
  ImuWitness witness;
  witness.reading = [&](double t) {
    ImuSample sample = witness.motion.imu(t);
    sample.accel /= 9.80665;
    return sample;
  };
  EXPECT_EQ(witness.verdict(3.0), ImuVerdict::kMended);
  EXPECT_THAT(witness.judge.findings(), ::testing::ElementsAre(::testing::HasSubstr("in g")));
}

TEST(ImuJudge, TurnsAWrongSignRound) {
  ImuWitness witness;
  witness.reading = [&](double t) {
    ImuSample sample = witness.motion.imu(t);
    sample.accel = -sample.accel;
    return sample;
  };
  EXPECT_EQ(witness.verdict(6.0), ImuVerdict::kMended);
  EXPECT_THAT(witness.judge.findings()[0], ::testing::HasSubstr("imu.accel_scale=-1"));
  const ImuSample mended = witness.judge.mended(witness.reading(2.0));
  EXPECT_LT((mended.accel - witness.motion.imu(2.0).accel).norm(), 1e-9);
}

TEST(ImuJudge, TellsAScaleFromABiasOnceItMoves) {
  for (const bool is_scale : {false, true}) {
    ImuWitness witness;
    witness.judge.judge_rest({0.0, 0.0, 1.15 * 9.81});
    ImuVerdict verdict = ImuVerdict::kUnknown;
    for (int i = 0; i < 9000 && verdict != ImuVerdict::kMended; ++i) {
      const double t = 0.01 * i;
      ImuSample sample = witness.motion.imu(t);
      const Eigen::Vector3d bias(0.0, 0.0, 0.15 * 9.81);
      sample.accel = is_scale ? Eigen::Vector3d(1.15 * sample.accel) : sample.accel + bias;
      witness.judge.add(sample);
      if (i % 10 == 9) {
        witness.judge.add(witness.pose(t));
        verdict = witness.judge.inspect(t);
      }
    }
    EXPECT_EQ(verdict == ImuVerdict::kMended, is_scale);
    EXPECT_NEAR(
        witness.judge.mended({0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.15}}).accel.z(),
        is_scale ? 1.0 : 1.15,
        1e-9);
    EXPECT_THAT(
        witness.judge.summary(),
        ::testing::ElementsAre(::testing::HasSubstr(is_scale ? "multiplied by 0.8696" : "bias")));
  }
}

TEST(ImuJudge, MissesGravityThatTheDriverRemoved) {
  for (const double share : {0.0, 1.0}) {
    ImuWitness witness;
    witness.reading = [&](double t) {
      ImuSample sample = witness.motion.imu(t);
      const Eigen::Vector3d up = witness.motion.pose(t).linear().transpose().col(2);
      sample.accel = share * (sample.accel - 9.81 * up);
      return sample;
    };
    EXPECT_EQ(witness.verdict(6.0), ImuVerdict::kUnusable) << share;
    EXPECT_THAT(witness.judge.findings()[0], ::testing::HasSubstr("of gravity")) << share;
  }
}

TEST(ImuJudge, FindsTheRotationOfAnExtrinsicThatIsNotGiven) {
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(3.14159, 0.0, 0.0), Eigen::Vector3d(0.0, 1.2, -0.7)}) {
    ImuWitness witness;
    witness.T_body_lidar.linear() = so3_exp(turn);
    EXPECT_EQ(witness.verdict(8.0), ImuVerdict::kUnusable);
    const Eigen::Quaterniond q(witness.T_body_lidar.linear());
    const std::string& finding = witness.judge.findings()[0];
    const std::size_t begin = finding.find("T_imu_lidar=[");
    ASSERT_NE(begin, std::string::npos) << finding;
    double numbers[7];
    ASSERT_EQ(
        std::sscanf(
            finding.c_str() + begin,
            "T_imu_lidar=[%lf, %lf, %lf, %lf, %lf, %lf, %lf]",
            numbers,
            numbers + 1,
            numbers + 2,
            numbers + 3,
            numbers + 4,
            numbers + 5,
            numbers + 6),
        7);
    const Eigen::Quaterniond found(numbers[6], numbers[3], numbers[4], numbers[5]);
    EXPECT_LT(q.angularDistance(found), 0.05) << finding;
  }
}

TEST(ImuJudge, FindsTheOffsetOfTheClocks) {
  for (const double late : {0.3, -0.25}) {
    ImuWitness witness;
    witness.motion.turning = 1.5;
    witness.reading = [&](double t) {
      ImuSample sample = witness.motion.imu(t - late);
      sample.time = t;
      return sample;
    };
    EXPECT_EQ(witness.verdict(8.0), ImuVerdict::kMended) << late;
    EXPECT_NEAR(witness.judge.take_clock_offset(), late, 0.015);
    EXPECT_EQ(witness.judge.take_clock_offset(), 0.0);
    const std::string finding = witness.judge.summary().at(0);
    const std::size_t begin = finding.find("imu.time_offset=");
    ASSERT_NE(begin, std::string::npos) << finding;
    EXPECT_NEAR(std::stod(finding.substr(begin + 16)), -late, 0.015) << finding;
  }
}

// Of another recording's readings some offset fits best in every stretch.
TEST(ImuJudge, DoesNotMoveTheClockOnAndOn) {
  ImuWitness witness;
  witness.motion.turning = 1.5;
  witness.reading = [&](double t) {
    ImuSample sample = witness.motion.imu(t - 0.35);
    sample.time = t;
    return sample;
  };
  EXPECT_EQ(witness.verdict(8.0), ImuVerdict::kMended);
  EXPECT_NEAR(witness.judge.take_clock_offset(), 0.35, 0.015);
  witness.judge.forget();  // and readings that have not been moved
  EXPECT_NE(witness.verdict(8.0), ImuVerdict::kMended);
  EXPECT_EQ(witness.judge.take_clock_offset(), 0.0);
  EXPECT_FALSE(witness.judge.findings().empty());
}

TEST(ImuJudge, RefusesFactorsThatAreNoNumbers) {
  ImuInputOptions options;
  options.accel_scale = std::nan("");
  EXPECT_THROW(ImuJudge(options, Pose::Identity(), 9.81), std::invalid_argument);
}

}  // namespace
}  // namespace nvm::lio
