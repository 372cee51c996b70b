// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <functional>
#include <random>

#include "lio/analytic_motion.hpp"
#include "lio/imu/imu_judge.hpp"
#include "support/rng.hpp"

namespace nvm::test {

/// Feeds a judge `duration` [s] of a swaying motion: readings at 100 Hz, changed, and noisy poses
/// at 10 Hz. Stops at its first verdict that is final.
class ImuWitness {
 public:
  std::function<ImuSample(double)> reading = [this](double t) { return motion.imu(t); };
  Pose T_body_lidar = Pose::Identity();  ///< that the poses wrongly do not know
  Pose mirror = Pose::Identity();        ///< that the scans were seen in
  lio::ImuInputOptions options;
  AnalyticMotion motion{-3.0};

  lio::ImuVerdict verdict(double duration) {
    lio::ImuVerdict verdict = lio::ImuVerdict::kUnknown;
    for (int i = 0; i < static_cast<int>(100 * duration); ++i) {
      judge.add(reading(0.01 * i));
      if (i % 10 == 9) {
        judge.add(pose(0.01 * i));
        verdict = judge.judge(1.0);
        if (verdict == lio::ImuVerdict::kUnusable || verdict == lio::ImuVerdict::kMended) {
          break;
        }
      }
    }
    return verdict;
  }

  StampedPose pose(double t) {
    Pose pose = mirror * T_body_lidar.inverse() * motion.pose(t) * T_body_lidar * mirror;
    for (int axis = 0; axis < 3; ++axis) {
      pose.translation()[axis] += 0.003 * noise(rng);
    }
    return {t, pose};
  }

  std::mt19937_64 rng = test::rng();
  std::normal_distribution<double> noise{0.0, 1.0};
  lio::ImuJudge judge{options, Pose::Identity(), 9.81};
};

}  // namespace nvm::test
