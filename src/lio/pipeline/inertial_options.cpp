// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include <cmath>

#include "lio/imu/imu_noise_learner.hpp"
#include "lio/pipeline/inertial_pipeline.hpp"
#include "nvm/core/require.hpp"

namespace nvm::lio {

void InertialOptions::validate() const {
  initializer.validate();
  returns.validate();
  normals.validate();
  keypoints.validate();
  const auto not_negative = [](double value, const char* key) {
    require(value >= 0.0 && std::isfinite(value), key, value, "0 or more");
  };
  not_negative(max_imu_gap, "max_imu_gap");
  require(
      min_inlier_share >= 0.0 && min_inlier_share <= 1.0,
      "min_inlier_share",
      min_inlier_share,
      "0 to 1");
  not_negative(imu_noise.gyro, "imu gyro noise");
  not_negative(imu_noise.accel, "imu accel noise");
  ImuNoiseLearner().complete(imu_noise, false).validate();
  not_negative(max_plane_offset, "max_plane_offset");
  not_negative(max_weak_duration, "max_weak_duration");
  not_negative(extrinsic_translation_deviation, "extrinsic_translation_deviation");
  not_negative(extrinsic_rotation_deviation, "extrinsic_rotation_deviation");
}

}  // namespace nvm::lio
