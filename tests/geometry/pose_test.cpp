// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "nvm/geometry/trajectory.hpp"
#include "support/rng.hpp"

namespace nvm {
namespace {

constexpr double kPi = 3.141592653589793;

/// A rotation vector of length `angle` [rad] in a random direction.
Eigen::Vector3d random_rotation(double angle, std::mt19937_64& rng) {
  std::normal_distribution<double> gauss;
  return angle * Eigen::Vector3d(gauss(rng), gauss(rng), gauss(rng)).normalized();
}

/// Angles [rad] from the smallest that a double tells from zero to a hair below half a turn.
constexpr double kAngles[] = {
    1e-300, 1e-12, 9.9e-9, 1.1e-8, 1e-6, 1e-3, 0.5, 1.5, 2.0, 2.1, 2.5, 3.0, 3.14, kPi - 1e-7};

TEST(So3, LogUndoesExpForEveryAngleBelowHalfATurn) {
  std::mt19937_64 rng = test::rng();
  for (const double angle : kAngles) {
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d rotation = random_rotation(angle, rng);
      const Eigen::Vector3d again = so3_log(so3_exp(rotation));
      EXPECT_LT((again - rotation).norm(), 1e-15 + 1e-8 * angle) << "angle " << angle;
    }
  }
}

TEST(So3, ExpIsTheAngleAxisRotation) {
  std::mt19937_64 rng = test::rng();
  for (const double angle : kAngles) {
    const Eigen::Vector3d rotation = random_rotation(angle, rng);
    const Eigen::Matrix3d expected =
        Eigen::AngleAxisd(angle, (rotation / angle).normalized()).toRotationMatrix();
    EXPECT_LT((so3_exp(rotation) - expected).norm(), 1e-14) << "angle " << angle;
  }
  EXPECT_EQ(so3_exp(Eigen::Vector3d::Zero()), Eigen::Matrix3d::Identity());
}

TEST(So3, LogOfMoreThanHalfATurnIsTheShorterWayRound) {
  std::mt19937_64 rng = test::rng();
  std::uniform_real_distribution<double> angle(kPi + 1e-3, 2.0 * kPi);
  for (int i = 0; i < 1000; ++i) {
    const double turned = angle(rng);
    const Eigen::Vector3d axis = random_rotation(1.0, rng);
    const Eigen::Vector3d expected = (turned - 2.0 * kPi) * axis;
    EXPECT_LT((so3_log(so3_exp(turned * axis)) - expected).norm(), 1e-8);
  }
}

TEST(So3, LogIsTheInverseTurnOfTheTranspose) {
  std::mt19937_64 rng = test::rng();
  std::uniform_real_distribution<double> angle(0.0, kPi - 1e-3);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d R = so3_exp(random_rotation(angle(rng), rng));
    EXPECT_LT((so3_log(R) + so3_log(R.transpose())).norm(), 1e-9);
  }
}

TEST(So3, TurnsOfOneAxisAdd) {
  std::mt19937_64 rng = test::rng();
  std::uniform_real_distribution<double> part(-1.5, 1.5);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d axis = random_rotation(1.0, rng);
    const double a = part(rng);
    const double b = part(rng);
    EXPECT_LT((so3_exp(a * axis) * so3_exp(b * axis) - so3_exp((a + b) * axis)).norm(), 1e-14);
  }
}

TEST(Pose, IsTheIdentityWhereNoneIsGiven) {
  EXPECT_EQ(StampedPose().pose.matrix(), Pose::Identity().matrix());
}

TEST(Skew, IsTheCrossProduct) {
  std::mt19937_64 rng = test::rng();
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d v = random_rotation(3.0, rng);
    const Eigen::Vector3d w = random_rotation(2.0, rng);
    EXPECT_LT((skew(v) * w - v.cross(w)).norm(), 1e-14);
  }
}

TEST(IsRigid, RefusesMirrorsScalesShearsAndWhatIsNotFinite) {
  Pose pose = Pose::Identity();
  pose.linear() = so3_exp({0.1, 2.0, -0.3});
  EXPECT_TRUE(is_rigid(pose));
  Pose mirror = pose;
  mirror.linear().col(0) *= -1.0;
  EXPECT_FALSE(is_rigid(mirror));
  Pose scaled = pose;
  scaled.linear() *= 1.001;
  EXPECT_FALSE(is_rigid(scaled));
  Pose sheared = pose;
  sheared.linear()(0, 1) += 1e-3;
  EXPECT_FALSE(is_rigid(sheared));
  Pose nowhere = pose;
  nowhere.translation().x() = std::nan("");
  EXPECT_FALSE(is_rigid(nowhere));
}

}  // namespace
}  // namespace nvm
