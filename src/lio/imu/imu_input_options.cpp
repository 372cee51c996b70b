// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "lio/imu/imu_input_options.hpp"

#include <cmath>

#include "nvm/core/require.hpp"

namespace nvm::lio {

void ImuInputOptions::validate() const {
  const auto finite = [](double value, const char* name) {
    require(std::isfinite(value), name, value, "a finite number");
  };
  finite(gyro_scale, "gyro_scale");
  finite(accel_scale, "accel_scale");
  finite(time_offset, "time_offset");
}

}  // namespace nvm::lio
