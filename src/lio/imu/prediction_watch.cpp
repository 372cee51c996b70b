// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/prediction_watch.hpp"

#include <algorithm>
#include <cmath>

#include "common/printed.hpp"

namespace nvm::lio {

void PredictionWatch::add(
    const ErrorStateFilter& predicted,
    const ErrorStateFilter& corrected,
    double inlier_share,
    double imu_interval) {
  // Standard deviations: with good IMUs none reaches two. At the edge of the map scans fit badly
  // without being corrected.
  constexpr double kUnlikely = 3.0;
  constexpr double kDoubtful = 1.0;
  constexpr double kBadFit = 0.9;  // of the usual share
  constexpr double kMemory = 0.1;  // weight of the newest share
  constexpr double kMissed = 4.0;  // between the readings of a slow IMU [m/s^2]
  const double usual_share = usual_share_.value_or(inlier_share);
  const double correction =
      (corrected.state().T_world_body.translation() - predicted.state().T_world_body.translation())
          .norm();
  const double deviation =
      std::sqrt(predicted.covariance().block<3, 3>(kPosition, kPosition).trace());
  const double missed = kMissed * imu_interval * imu_interval;
  const bool is_unlikely = correction > kUnlikely * deviation + missed;
  is_doubtful_ = is_unlikely || (correction > kDoubtful * deviation + missed &&
                                 inlier_share < kBadFit * usual_share);
  usual_share_ = usual_share + kMemory * (inlier_share - usual_share);
  ++count_;
  if (is_unlikely) {
    ++unexpected_;
    largest_ = std::max(largest_, correction);
  }
}

std::string PredictionWatch::finding() const {
  constexpr double kOften = 0.02;
  constexpr std::size_t kLeast = 5;
  const double share = static_cast<double>(unexpected_) / static_cast<double>(count_);
  if (unexpected_ < kLeast || share < kOften) {
    return "";
  }
  return printed(
      "in %.0f %% of the scans the IMU leads the pose astray, by up to %.0f mm, which its noise "
      "does "
      "not explain: check the scale and the axes of its accelerometer, input.T_imu_lidar and its "
      "clock",
      100.0 * share,
      1e3 * largest_);
}

}  // namespace nvm::lio
