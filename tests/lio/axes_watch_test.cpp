// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/axes_watch.hpp"

#include <gmock/gmock.h>

#include <optional>

#include "lio/analytic_motion.hpp"
#include "lio/imu_witness.hpp"
#include "support/rng.hpp"

namespace nvm::lio {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kDegree = 0.017453292519943295;  // [rad]

struct Mount {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< of the axes that poses take for the IMU's
  double late = 0.0;                               ///< the IMU's clock [s]
  double scale = 1.0;                              ///< of what the gyroscope reads
  Eigen::Vector3d axis_scale = Eigen::Vector3d::Ones();
  double noise = 5e-5;     ///< of poses [rad]
  double duration = 20.0;  ///< [s]
  double rest = -3.0;      ///< until then the body rests [s]
};

/// What is found of a turning motion, with poses at 10 Hz.
std::optional<Eigen::Vector3d> found_turn(const Mount& mount) {
  auto generator = test::rng();
  std::normal_distribution<double> normal(0.0, mount.noise);
  test::AnalyticMotion motion{mount.rest};
  motion.turning = 1.5;
  MotionHistory history;
  AxesWatch axes;
  for (int i = 0; i < static_cast<int>(100.0 * mount.duration); ++i) {
    const double t = 0.01 * i;
    ImuSample reading = motion.imu(t - mount.late);
    reading.time = t;
    reading.gyro = mount.scale * mount.axis_scale.cwiseProduct(reading.gyro) +
                   Eigen::Vector3d(0.01, -0.01, 0.02);  // a bias
    history.add(reading);
    if (i % 10 == 9) {
      Pose pose = motion.pose(t);
      pose.linear() *= so3_exp(mount.turn).transpose();
      pose.linear() *=
          so3_exp(Eigen::Vector3d(normal(generator), normal(generator), normal(generator)));
      history.add(StampedPose{t, pose});
    }
    if (i % 300 == 299) {
      axes.look(history, t - 3.0, 0.0);
    }
  }
  const auto finding = axes.finding();
  if (finding) {
    EXPECT_NEAR(finding->lateness, mount.late, 0.002);
  }
  return finding ? std::optional<Eigen::Vector3d>(so3_log(finding->rotation)) : std::nullopt;
}

TEST(AxesWatch, FindsTheTurnWhateverTheGyroscopesBiasScaleAndClock) {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1.0, 0.0, 0.0),
        Eigen::Vector3d(0.0, 1.0, 0.0),
        Eigen::Vector3d(0.0, 0.0, 1.0),
        Eigen::Vector3d(0.6, -0.64, 0.48)}) {
    for (const double degrees : {2.0, 5.0, 10.0}) {
      Mount mount;
      mount.turn = degrees * kDegree * axis;
      mount.late = 0.004;
      mount.scale = 1.01;
      const auto found = found_turn(mount);
      ASSERT_TRUE(found) << degrees << " degrees about " << axis.transpose();
      EXPECT_LT((*found - mount.turn).norm(), 0.06 * mount.turn.norm())
          << degrees << " degrees about " << axis.transpose();
    }
  }
}

TEST(AxesWatch, FindsNoneWhereThereIsNone) {
  for (const double late : {-0.02, 0.0, 0.02}) {
    for (const double scale : {0.97, 1.0, 1.03}) {
      Mount mount;
      mount.late = late;
      mount.scale = scale;
      EXPECT_FALSE(found_turn(mount)) << late << " s late, times " << scale;
    }
  }
}

/// One axis of the gyroscope is wrong: no rotation mends that.
TEST(AxesWatch, FindsNoneWhereSomethingElseIsWrong) {
  for (const double scale : {0.0, 0.9, 1.1, -1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      Mount mount;
      mount.axis_scale[axis] = scale;
      EXPECT_FALSE(found_turn(mount)) << "axis " << axis << " times " << scale;
    }
  }
}

TEST(AxesWatch, FindsNoneOfHalfADegree) {
  Mount mount;
  mount.turn = {0.0, 0.5 * kDegree, 0.0};
  EXPECT_FALSE(found_turn(mount));
}

TEST(AxesWatch, FindsNoneOfABodyAtRest) {
  Mount mount;
  mount.turn = {0.0, 5.0 * kDegree, 0.0};
  mount.rest = 1e9;
  EXPECT_FALSE(found_turn(mount));
}

TEST(AxesWatch, FindsNoneAmongPosesOfMuchNoise) {
  Mount mount;
  mount.noise = 0.02;
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(found_turn(mount));
  }
}

/// What a judge makes of half a minute of a turning motion.
void watch(test::ImuWitness& witness) {
  witness.motion.turning = 1.5;
  for (int i = 0; i < 3000; ++i) {
    const double t = 0.01 * i;
    witness.judge.add(witness.reading(t));
    if (i % 10 == 9) {
      witness.judge.add(witness.pose(t));
      witness.judge.inspect(t);
    }
  }
}

TEST(ImuJudge, LearnsHowTheLidarIsTurned) {
  for (const double degrees : {2.0, 6.0}) {
    test::ImuWitness witness;
    witness.T_body_lidar.linear() = so3_exp(degrees * kDegree * Eigen::Vector3d(0.6, -0.64, 0.48));
    watch(witness);
    EXPECT_THAT(witness.judge.summary(), ElementsAre(HasSubstr("the LiDAR is turned by ")));
    const auto better = witness.judge.better_setup();
    ASSERT_TRUE(better);
    const Eigen::Matrix3d left =
        better->T_imu_lidar.linear().transpose() * witness.T_body_lidar.linear();
    EXPECT_LT(so3_log(left).norm(), 0.08 * degrees * kDegree);
  }
}

// The mount of the LiDAR would turn the accelerometer too.
TEST(ImuJudge, DoesNotTurnTheLidarForAGyroscopeThatIsTurned) {
  test::ImuWitness witness;
  witness.reading = [&](double t) {
    ImuSample sample = witness.motion.imu(t);
    sample.gyro = so3_exp(6.0 * kDegree * Eigen::Vector3d(0.6, -0.64, 0.48)) * sample.gyro;
    return sample;
  };
  watch(witness);
  EXPECT_THAT(witness.judge.summary(), Not(Contains(HasSubstr("is turned by "))));
  const auto better = witness.judge.better_setup();  // by its clock, which that looks like
  EXPECT_TRUE(!better || better->T_imu_lidar.isApprox(Pose::Identity()));
}

}  // namespace
}  // namespace nvm::lio
