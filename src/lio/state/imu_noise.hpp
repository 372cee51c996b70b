// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

namespace nvm::lio {

/// Noise of the IMU, as spectral densities (continuous-time white noise and bias random walk).
struct ImuNoise {
  double gyro = 5e-4;        ///< [rad/s/sqrt(Hz)]
  double accel = 4e-3;       ///< [m/s^2/sqrt(Hz)]
  double gyro_bias = 1e-5;   ///< [rad/s^2/sqrt(Hz)]
  double accel_bias = 1e-4;  ///< [m/s^3/sqrt(Hz)]
  /// White noise of the gyroscope for each rad/s that it turns [1/sqrt(Hz)], 0 or more: over a scan
  /// of 0.1 s as much as an error of scale or axes of 1 %, which real ones have.
  double gyro_scale = 3e-3;

  void validate() const;
};

}  // namespace nvm::lio
